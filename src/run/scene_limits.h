#pragma once
// The limits of a scene as TOML: [limits] and [limits.MEASURE].

#include <string>

#include "run/scene.h"
#include "run/toml_value.h"

namespace espalier {

/// Reads the table `limits` into scene.limits and scene.search.ga.genes. Throws Error.
void read_limits(const TomlValue& table, const std::string& file, Scene& scene);

/// Every setting written out; limits that ask nothing are left out, but for genes, whose hard limits always hold.
std::string limits_to_toml(const Scene& scene);

/// What the objective limits: scene.limits with the hard limits on genes.
Limits limits_of(const Scene& scene);

}  // namespace espalier
