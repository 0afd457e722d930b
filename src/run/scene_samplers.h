#pragma once
// Settings of the samplers (SMC, SOSMC, RJMCMC, guided) and of the hybrid as TOML, for run/scene_engines.

#include <string>

#include "run/toml_section.h"
#include "search/guided_settings.h"
#include "search/hybrid_settings.h"

namespace espalier {

/// What the table says replaces what is there. Throws Error.
void read_smc(TomlSection& s, SmcSettings& settings);
void read_rjmcmc(TomlSection& s, RjmcmcSettings& settings);
void read_guided(TomlSection& s, GuidedSettings& settings);
void read_hybrid(TomlSection& s, HybridSettings& settings);  // but not those of its engines

/// Every setting written out, a line each.
std::string to_toml(const SmcSettings& settings);
std::string to_toml(const RjmcmcSettings& settings);
std::string to_toml(const GuidedSettings& settings);
std::string to_toml(const HybridSettings& settings);

}  // namespace espalier
