#pragma once
// Reach: whether the grammar can get to where the targets are, told from a few models before the search starts.

#include <string>
#include <vector>

#include "run/setup.h"

namespace espalier {

/// One line per target to be filled of which much is covered by none of a few hundred models, grown to lengths between
/// the gene limits from the scene's seed. Such a target may be misplaced or of another scale than the grammar.
std::vector<std::string> warn_of_reach(const Setup& setup);

}  // namespace espalier
