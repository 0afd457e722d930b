#pragma once
// Scenes between the page, which has them as JSON, and the reader of scene files, which judges them.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/kind.h"
#include "run/scene.h"

namespace espalier::studio {

/// What a scene's reader must know of the project.
struct SceneSurroundings {
  std::string grammar = "grammar.esp";      // path
  std::string folder;                       // that paths are relative to
  std::map<std::string, Kind> attributes;   // of the grammar; the scene's others are left out
};

struct ReadScene {
  Scene scene;               // without [start]
  bool has_targets = false;  // without, the search has nothing to look for
  std::vector<std::string> locks;  // "Trunk/Branch"
};

/// Throws Error naming key, rule and value; lists of targets may be empty, the budget may be missing.
ReadScene read_scene(std::string_view json, const SceneSurroundings& surroundings);

/// The values of a scene's attributes as the language writes them, for attributes that the grammar has.
std::map<std::string, std::string> attributes_of(std::string_view json, const std::map<std::string, Kind>& known);

/// A scene file as the page's JSON: without its version, grammar and start. Throws Error.
std::string scene_json(std::string_view toml, const std::string& name);
/// The path of the grammar in a scene file, and of every other file that it names. Throws Error.
std::string grammar_of(std::string_view toml, const std::string& name);
std::vector<std::string> files_of(std::string_view json);
/// The scene with each of its files named by what `names` says; others stay.
std::string with_files(std::string_view json, const std::map<std::string, std::string>& names);

/// The scene with these locks instead of its own.
std::string with_locks(std::string_view json, const std::vector<std::string>& locks);
std::vector<std::string> locks_of(std::string_view json);

}  // namespace espalier::studio
