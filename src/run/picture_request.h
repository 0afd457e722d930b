#pragma once
// PictureRequest: what a picture or a turntable is to show and how: the options of `espalier render`. Plain data; its
// TOML lies in the provenance of the picture, so that it can be made again.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec.h"
#include "render/render.h"

namespace espalier {

enum class PictureView : std::uint8_t { full, parts, bones };

struct PictureRequest {
  static constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 25;       // of a picture: 8K
  static constexpr std::uint64_t kMostStripPixels = std::uint64_t{1} << 27;  // of a strip
  static constexpr std::uint32_t kMostSide = 16384, kMostFrames = 3600, kMostStripSide = 65535;

  std::array<std::uint32_t, 2> size = {1200, 900};  // of a frame
  double azimuth_deg = 35, elevation_deg = 22;
  std::optional<Vec3> eye, at;        // m; `at` needs `eye`
  std::optional<double> fov_deg, tall;
  std::uint32_t samples = 16;
  bool ground = true, transparent = false;
  std::string background;             // "#rrggbb"; empty: the backdrop
  PictureView view = PictureView::full;
  std::optional<LevelOfDetail> detail;  // none: parts as the grammar makes them
  bool targets = false;               // the scene's meshes as ghosts
  std::uint32_t frames = 0;           // 0: one picture, else a turntable
  std::uint32_t columns = 0;          // of its strip; 0: chosen
  bool fixed_light = false;
  std::optional<std::uint32_t> frame;  // only this one of the turntable: what lies in the file

  bool operator==(const PictureRequest&) const = default;
};

/// Throws Error, in the words of the command line, for values out of range and those that exclude each other.
void check(const PictureRequest& request);

/// All options as TOML, and back. Throws Error.
std::string to_toml(const PictureRequest& request);
PictureRequest parse_picture_request(std::string_view text, const std::string& name);

/// "view", "columns".. as the renderer takes them.
RenderSettings render_settings(const PictureRequest& request);

}  // namespace espalier
