#pragma once
// Settings of Genesis as TOML, for run/scene_engines.

#include <string>

#include "run/toml_section.h"
#include "search/genesis_settings.h"

namespace espalier {

/// What the table says replaces what is there. Throws Error.
void read_genesis(TomlSection& s, GenesisSettings& settings);

/// Every setting written out, a line each.
std::string to_toml(const GenesisSettings& settings);

}  // namespace espalier
