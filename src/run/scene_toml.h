#pragma once
// Scenes as TOML (docs/scenes.md).

#include <string>
#include <string_view>
#include <vector>

#include "run/scene.h"

namespace espalier {

/// What the command line changes in a scene.
struct SceneOverrides {
  std::vector<std::string> settings;    // "dotted.key=value"
  std::vector<std::string> attributes;  // "name=value"
};

inline constexpr std::uint64_t kMostSceneBytes = 16ull << 20;

/// Reads a scene file. Throws Error naming file, place, key, rule and value.
Scene load_scene(const std::string& path, const SceneOverrides& overrides = {});
/// The same from text; `name` stands for the file in messages, paths are relative to `folder`.
Scene parse_scene(std::string_view text, const std::string& name, const std::string& folder,
                  const SceneOverrides& overrides = {});

/// The scene with every setting written out; parse_scene gives back an equal scene (folder and threads aside).
std::string to_toml(const Scene& scene);

}  // namespace espalier
