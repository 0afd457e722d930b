#pragma once
// A scene with guiding curves and a grammar whose bones are known: for tests of what is drawn and told of curves.

#include <memory>
#include <string>

#include "io/mesh_import.h"
#include "model/expand.h"
#include "run/fixtures.h"
#include "run/probes.h"
#include "run/scene_toml.h"
#include "run/setup.h"

namespace espalier::testing {

/// A stem of sticks, each half a metre long, upright or bent to the side.
inline constexpr const char* kStickGrammar = R"(grammar sticks 1
start Stem
rule Stem { spawn Stick }
rule Stick when depth < 20 {
  lean ~ uniform(-90deg, 90deg)
  turn z lean
  bone (0, 0, 0) -> (0, 0.5, 0)
  { move y 0.25  size (0.08, 0.5, 0.08)  emit box }
  move y 0.5
  maybe 0.85 spawn Stick
}
)";

inline constexpr const char* kUpright = "[[curves.curve]]\npoints = [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]]\n"
                                        "segment = 0.5\nutilisation = 100\n";

inline std::string stick_scene(const std::string& targets) {
  return "espalier = 1\ngrammar = \"sticks.esp\"\nseed = 2\nbudget.generations = 40\nsearch.engine = \"guided\"\n"
         "engine.guided.steps = 8\nlimits.genes.min = 1\noutput.keep = 1\noutput.picture = [96, 72]\n" + targets;
}

inline std::unique_ptr<Setup> set_up_sticks(const TemporaryFolder& folder, const std::string& targets) {
  write_text(folder / "sticks.esp", kStickGrammar);
  AssimpMeshSource source;
  return set_up(parse_scene(stick_scene(targets), "scene.toml", folder.path()), source);
}

/// With these bones and no parts.
inline Model skeleton(const std::vector<std::pair<Vec3, Vec3>>& bones) {
  Model model;
  for (const auto& [from, to] : bones) model.bones.push_back({from, to, -1, 0});
  return model;
}

}  // namespace espalier::testing
