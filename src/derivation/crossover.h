#pragma once
// Crossover: swaps a subtree of one derivation with a compatible one of another. ShapeGenetics 2017, algorithm 2 (by
// edge), and the shape-grammar GA of 2016, algorithm 1 (by symbol).

#include <cstdint>

#include "base/random.h"
#include "derivation/derivation.h"
#include "derivation/locks.h"

namespace espalier {

enum class Compatibility : std::uint8_t {
  edge,    // 2017: two filled slots of one edge
  symbol,  // 2016: the same child rule in any slot, or an empty slot that takes it if the giver's slot is optional
};

struct CrossoverSettings {
  Compatibility compatibility = Compatibility::edge;
  int retries = 3;                 // attempts in all, >= 1
  double replace_probability = 1;  // symbol: chance that a match beside an empty slot is replaced rather than added
};

struct CrossoverResult {
  bool crossed = false;  // false: the children are copies of their parents
  int tries = 0;         // attempts made; 0 where parent 1 has no gene that may go
};

/// Each attempt picks a gene of parent 1 uniformly (never the start gene), then uniformly one of the places in parent 2
/// that are compatible with it, and swaps the subtrees. Where an empty slot of parent 2 takes the subtree, child 1 just
/// loses it. By symbol, a match with an empty slot beside it (of the same gene, leading to the same rule, and free to
/// take the subtree) is considered with `replace_probability` only.
///
/// A subtree that comes to another depth has its guards evaluated again: empty or open slots whose guard fails there
/// become absent, absent ones whose guard holds there become empty. Not compatible is a swap after which a guard fails
/// for a gene, a required slot is left empty, a variant or filled slot has probability 0, a limit is broken, or
/// anything that locks of a parent hold has gone from its child. Of the places that look alike but are not compatible,
/// at most 64 are passed over in one attempt.
///
/// Genes are conserved: together the children hold exactly the parents' genes (a moved gene may take another edge to
/// the same rule). Each child descends from its parent, with its start gene and detail seed. The children must not be
/// the parents or each other; their storage is reused, nothing is allocated once warm.
CrossoverResult crossover(const GeneratorGraph& graph, const Derivation& parent1, const Derivation& parent2,
                          const Locks& locks1, const Locks& locks2, const CrossoverSettings& settings,
                          RandomStream& random, Derivation& child1, Derivation& child2);

}  // namespace espalier
