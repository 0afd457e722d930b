#pragma once
// The start of a scene as TOML: [start] names a derivation to start from, and which of its genes to keep.

#include <string>

#include "derivation/locks.h"
#include "run/scene.h"
#include "run/toml_value.h"

namespace espalier {

/// Throws Error naming file, place, key, rule and value. Whether paths of genes lead anywhere is not asked yet.
SceneStart read_start(const TomlValue& table, const std::string& file);
/// "PATH", "PATH:subtree", "PATH:draws" or "PATH:structure". Throws Error for another word after the colon.
SceneLock parse_scene_lock(const std::string& text);

/// Every setting written out; empty where there is no start.
std::string start_to_toml(const SceneStart& start);

}  // namespace espalier
