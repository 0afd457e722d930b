#pragma once
// Values of draws: what the quantiles of a derivation come to where their genes stand, by running the genes' programs.

#include <optional>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

/// One per quantile of `derivation`, a valid derivation of the graph, in its order: the value (angles in radians,
/// lengths in metres), of `pick` the index of the alternative, of `chance` 0 for true and 1 for false. In a gene that
/// is shown several times: at the first. Nothing where a gene is never run because a size above it is negative or not
/// finite, and for a `chance` whose probability is not constant.
std::vector<std::optional<float>> draw_values(const GeneratorGraph& graph, const Derivation& derivation);

}  // namespace espalier
