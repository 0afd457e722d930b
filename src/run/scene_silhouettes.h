#pragma once
// The silhouettes of a scene as TOML, and their way from there to projections and weights.

#include <string>

#include "model/mesh.h"
#include "run/scene.h"
#include "run/toml_value.h"

namespace espalier {

/// Reads one table of the list `silhouette`. Throws Error.
SceneSilhouette read_silhouette(const TomlValue& table, const std::string& file, std::size_t index);
/// Every setting written out.
std::string silhouette_to_toml(const SceneSilhouette& silhouette);

/// A camera that frames `box` from the side that a fitting camera asks for; others stay as they are.
void settle_camera(SceneSilhouette& silhouette, const Bounds& box);
/// Of settled silhouettes; `size` in pixels. Throws Error.
Projection projection_of(const SceneSilhouette& silhouette, std::array<std::uint32_t, 2> size);

}  // namespace espalier
