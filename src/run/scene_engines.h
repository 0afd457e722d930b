#pragma once
// The search of a scene as TOML: [search] chooses an engine and may hold its settings, [engine.NAME] holds settings for
// one engine, which apply when that engine is chosen.

#include <string>

#include "run/scene.h"
#include "run/toml_value.h"

namespace espalier {

/// The engine that the document names, before anything of it is replaced from the command line; "ga" where it names
/// none.
std::string engine_of_file(const TomlValue& document);

/// Reads `search` and `engine` of the document. What [search] says in the file is meant for the engine that the file
/// names, what the command line says there for the one that is chosen. A setting of [engine.NAME] wins over the same
/// one in [search], unless that one was given on the command line. Settings for engines that are not chosen are held to
/// their rules too. Throws Error.
void read_search(const TomlValue& document, const std::string& engine_of_file, const std::string& file,
                 SceneSearch& search);

/// The gene limits of `ga` become those of all engines.
void share_limits(SceneSearch& search);

/// Throws Error where settings of the chosen engine do not go together.
void validate_search(const SceneSearch& search);

/// Every setting written out.
std::string search_to_toml(const SceneSearch& search);

}  // namespace espalier
