#pragma once
// The search of a scene as TOML: [search] chooses an engine and may hold its settings, [engine.NAME] holds settings for
// one engine, which apply when that engine is chosen.

#include <string>

#include "run/scene.h"
#include "run/toml_value.h"

namespace espalier {

/// Reads `search` and `engine` of the document. A setting of [engine.NAME] wins over the same one in [search], unless
/// that one was given on the command line. Settings for engines that are not chosen are held to their rules too.
/// Throws Error.
void read_search(const TomlValue& document, const std::string& file, SceneSearch& search);

/// Every setting written out.
std::string search_to_toml(const SceneSearch& search);

}  // namespace espalier
