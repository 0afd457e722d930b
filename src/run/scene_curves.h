#pragma once
// The guiding curves of a scene as TOML: [curves], [[curves.curve]] and [curves.density].

#include <string>

#include "run/scene.h"
#include "run/toml_value.h"

namespace espalier {

/// Throws Error that names file, place, key and rule.
SceneCurves read_curves(const TomlValue& table, const std::string& file);

/// Every setting written out; empty where there are no curves.
std::string curves_to_toml(const SceneCurves& curves);

}  // namespace espalier
