#pragma once
// Nudge: the local variant of alter. It moves one quantile a little instead of drawing a gene afresh.

#include "base/random.h"
#include "derivation/derivation.h"
#include "derivation/locks.h"

namespace espalier {

/// Moves one draw component, chosen uniformly within a gene chosen uniformly among those that have free draws, by a
/// step whose scale is drawn log-uniformly from 1/2 down to 1/512 (triangular within the scale). Continuous quantiles
/// reflect at 0 and 1, circular ones wrap, and those of n values step by at least 1/n (language.md 16). A step and its
/// reverse are equally likely. In place; false, with nothing changed, when no gene has a free draw.
bool nudge(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random);

/// The same for gene number `gene`, which has draws.
void nudge_gene(const GeneratorGraph& graph, Derivation& derivation, std::uint32_t gene, RandomStream& random);

}  // namespace espalier
