#pragma once
// The options that decide about meshes, for the verbs that have them.

#include <optional>

#include "cmd/options.h"
#include "model/level_of_detail.h"

namespace espalier {

/// Nothing where none was given: parts as the grammar makes them. Throws Error.
std::optional<LevelOfDetail> level_of(const DetailOptions& options);

}  // namespace espalier
