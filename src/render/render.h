#pragma once
// Shaded pictures of models on the CPU: a framed three-quarter view with soft shadows on a ground, and the target as a
// translucent ghost. The same bytes on every machine and for any number of threads.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "model/level_of_detail.h"
#include "model/model.h"
#include "model/surfaces.h"

namespace espalier {

/// 8-bit sRGB, rows from the top, `rgb[3 * (x + width * y) + channel]`.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha = {};  // one per pixel, colours not multiplied by it; empty: all is opaque
};

/// In model space, m. Looking along `up`, what is up in the picture is anyone's guess.
struct CameraPlace {
  Vec3 eye{0, 0, 5};
  std::optional<Vec3> at;  // none: the middle of all that is shown
  Vec3 up{0, 1, 0};
};

struct RenderSettings {
  std::uint32_t width = 1200, height = 900;
  float azimuth_deg = 35, elevation_deg = 22;  // where the camera stands, seen from the middle of the model
  bool full = true;                            // else parts
  std::optional<LevelOfDetail> detail = {};    // none: parts as the grammar makes them
  int samples = 16;                            // per pixel, where edges cross it; 1..256

  std::optional<CameraPlace> place;  // instead of azimuth, elevation and framing
  std::optional<float> fov_deg;      // vertical angle of view, in (0, 180); none: a long lens
  std::optional<float> tall;         // m from the picture's lower edge to its upper, > 0: parallel rays
  bool ground = true;                // which shows nothing but shadows
  bool transparent = false;          // alpha instead of a background; the ground's shadows stay
  std::optional<Vec3> background;    // linear light; none: a light backdrop
  std::optional<Vec3> to_light;      // towards the key light, not 0; none: over the camera's left shoulder
};

/// A picture of the model; `ghosts` are meshes in model space drawn as translucent shells. Frames what it is given; an
/// empty model gives an empty stage.
Picture render(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
               const std::vector<Mesh>& ghosts, const RenderSettings& settings, Executor& executor);

struct Turntable {
  std::uint32_t frames = 8;  // evenly around the model; the first is what `settings` ask for
  bool fixed_light = false;  // stays with the model; else with the camera
  std::optional<std::uint32_t> only = {};  // this frame alone
};

/// The camera goes round the vertical axis of the model, or round what `settings.place` looks at, against the clock
/// seen from above. All frames have the same distance and lens, which show the model whole from all sides. Calls
/// take(0, ..), take(1, ..) one after another.
void render_turntable(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
                      const std::vector<Mesh>& ghosts, const RenderSettings& settings, const Turntable& turntable,
                      Executor& executor, const std::function<void(std::uint32_t frame, Picture picture)>& take);

/// A strip: equal frames side by side without gaps, row by row. Columns that bring it near to 4:3 and leave few places
/// empty; a strip with nothing in it, of frames like this; and the frame of a number put into its place.
std::uint32_t strip_columns(std::size_t frames, std::uint32_t width, std::uint32_t height);
Picture empty_strip(std::size_t frames, const Picture& frame, std::uint32_t columns);
void paste_frame(Picture& strip, const Picture& frame, std::size_t number, std::uint32_t columns);

struct SheetCell {
  Picture picture;
  std::string caption;  // printable ASCII
};

/// A contact sheet: equal cells in rows, captions below, in so many columns; 0 = as near to 4:3 as the number allows.
Picture contact_sheet(const std::vector<SheetCell>& cells, const std::string& title, std::uint32_t columns = 0);

}  // namespace espalier
