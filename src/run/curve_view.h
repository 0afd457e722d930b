#pragma once
// Curve view: a scene's guiding curves as a picture: alone, or over a model and its bones. Whatever would hide them,
// curves and bones are seen whole; segments that are used differ from those that are not.

#include <array>
#include <cstdint>

#include "base/executor.h"
#include "render/render.h"
#include "run/curve_marks.h"
#include "run/setup.h"

namespace espalier {

/// From the side that `look` says, framed to show all curves (and the model); its place and lens are not looked at.
/// Thickness, the region of a density and the scene's meshes are ghosts. The scene must have curves.
Picture curve_view(const Setup& setup, const RenderSettings& look, Executor& executor);
Picture curve_view(const Setup& setup, const Model& model, const Surfaces& surfaces, const RenderSettings& look,
                   Executor& executor);

/// A closed mesh around a curve: the points within its thickness of it. Empty where it has none.
Mesh thickness_tube(const GuidingCurve& guide);

}  // namespace espalier
