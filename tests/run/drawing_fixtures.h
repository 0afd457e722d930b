#pragma once
// A scene with a drawing from a camera, the same as a shadow, and a volume: for tests of what is drawn of targets.

#include <memory>
#include <string>
#include <vector>

#include "io/image.h"
#include "io/mesh_import.h"
#include "run/fixtures.h"
#include "run/scene_toml.h"
#include "run/setup.h"

namespace espalier::testing {

inline constexpr const char* kPinhole = R"([[silhouette]]
image = "drawing.png"
size = [120, 90]
view = "parts"
[silhouette.camera]
distance = 14
azimuth_deg = 40
elevation_deg = -25
at = [0, 1.5, 0]
up = [0.3, 1, 0.1]
fov_deg = 50
)";

inline constexpr const char* kParallel = R"([[silhouette]]
image = "drawing.png"
size = [80, 120]
[silhouette.camera]
eye = [0, 2, 9]
at = [0, 2, 0]
tall = 8
)";

inline constexpr const char* kFloor = R"([[silhouette]]
image = "drawing.png"
weight = 0.5
[silhouette.shadow]
sun = [0.4, -1, 0.2]
tall = 9
)";

inline constexpr const char* kWall = R"([[silhouette]]
image = "drawing.png"
[silhouette.shadow]
lamp = [-6, 2, 0.5]
centre = [4, 2, 0]
normal = [1, 0, 0]
up = [0, 1, 0]
tall = 12
)";

inline constexpr const char* kTowerVolume = "[volume]\ncells = 8000\n[[volume.mesh]]\nfile = \"meshes/tower.obj\"\n";

/// Black at the left, at the right white above and light grey below.
inline void write_drawing(const TemporaryFolder& folder) {
  write_pile(folder);
  std::vector<std::uint8_t> rgb;
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 80; ++column) rgb.insert(rgb.end(), 3, column < 40 ? 0 : row < 30 ? 255 : 190);
  write_png(folder / "drawing.png", 80, 60, rgb, {});
}

inline std::string drawing_scene(const std::string& targets) {
  return "espalier = 1\ngrammar = \"pile.esp\"\nbudget.generations = 3\nsearch.population = 20\n"
         "search.elitism = 2\nsearch.initial_length = [5, 15]\noutput.keep = 1\noutput.picture = [64, 48]\n" + targets;
}

inline std::unique_ptr<Setup> set_up_drawing(const TemporaryFolder& folder, const std::string& targets) {
  write_drawing(folder);
  AssimpMeshSource source;
  return set_up(parse_scene(drawing_scene(targets), "scene.toml", folder.path()), source);
}

}  // namespace espalier::testing
