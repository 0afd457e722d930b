#pragma once
// Proposals of Markov chains: moves that know how likely they are, forwards and backwards. Each changes a derivation in
// place and gives
//
//     log ( prior(after) q(after -> before) / (prior(before) q(before -> after)) ),
//
// so that a chain that accepts with probability min(1, exp(that + beta * (score after - score before))) leaves
// prior * exp(beta * score) as it is. Nothing where there is no such move, or where the prior throws what was drawn
// away: the chain then stays where it is, and the derivation may be half changed. No derivation may have open slots.
// (Talton et al. 2011, sections 5.1 and 5.2; ShapeGenetics 2017, section 7.)
//
// Structure is drawn from the prior, so only the chance of choosing the place is left of the ratio. Draws are uniform
// in their quantiles and count nothing; those that stay where slot path, rule and variant agree map one to one.

#include <cstdint>
#include <optional>

#include "base/random.h"
#include "derivation/derivation.h"
#include "derivation/locks.h"

namespace espalier {

/// How the place of a proposal is chosen.
enum class PlaceChoice : std::uint8_t {
  uniform,
  by_level,  // first a level of the tree, uniformly among those with a candidate, then one of it: the few near the
             // start are chosen as often as the many at the tips (Talton et al. 2011, "nonterminal selection")
};

enum class DrawStep : std::uint8_t {
  fresh,  // all draws of the gene, from the prior
  local,  // one of them, moved a little (nudge.h)
};

/// New draws for one gene that has any; its number is given to `*chosen` if that is not null. The ratio is 0.
std::optional<double> propose_draws(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks,
                                    PlaceChoice choice, DrawStep step, RandomStream& random,
                                    std::uint32_t* chosen = nullptr);

/// A gene's variant and all that stands below are drawn anew. At most `most_genes` genes in all.
std::optional<double> propose_jump(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks,
                                   PlaceChoice choice, std::uint32_t most_genes, RandomStream& random);

/// One slot that is not absent is decided anew, with all that stands on it: smaller steps than a jump at its gene.
std::optional<double> propose_slot(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks,
                                   PlaceChoice choice, std::uint32_t most_genes, RandomStream& random);

}  // namespace espalier
