#pragma once
// Shaded pictures of models on the CPU: a framed three-quarter view with soft shadows on a ground, and the target as a
// translucent ghost. The same bytes on every machine and for any number of threads.

#include <cstdint>
#include <string>
#include <vector>

#include "base/executor.h"
#include "model/model.h"
#include "model/surfaces.h"

namespace espalier {

/// 8-bit sRGB, rows from the top, `rgb[3 * (x + width * y) + channel]`.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

struct RenderSettings {
  std::uint32_t width = 1200, height = 900;
  float azimuth_deg = 35, elevation_deg = 22;  // where the camera stands, seen from the middle of the model
  bool full = true;                            // else parts
  int samples = 16;                            // per pixel
};

/// A picture of the model; `ghosts` are meshes in model space drawn as translucent shells. Frames what it is given; an
/// empty model gives an empty stage.
Picture render(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
               const std::vector<Mesh>& ghosts, const RenderSettings& settings, Executor& executor);

struct SheetCell {
  Picture picture;
  std::string caption;  // printable ASCII
};

/// A contact sheet: equal cells in rows, captions below, in so many columns; 0 = as near to 4:3 as the number allows.
Picture contact_sheet(const std::vector<SheetCell>& cells, const std::string& title, std::uint32_t columns = 0);

}  // namespace espalier
