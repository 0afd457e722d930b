#pragma once
// Moves: what changes a derivation. Each is a free function of (graph, derivation, locks, random stream), works in place
// and returns false, leaving the derivation untouched, when no such move exists. Every result is a valid derivation of
// the graph: guards and limits hold. Probabilities: ShapeGenetics 2017, section 5; design section 3.

#include "base/random.h"
#include "derivation/derivation.h"
#include "derivation/locks.h"

namespace espalier {

/// Fills an empty slot, chosen with probability proportional to its p. Variant and draws are fresh; required slots below
/// are grown, optional ones stay empty.
bool grow(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random);

/// Empties a filled optional slot, chosen with probability proportional to 1 - p, with all that stands on it.
bool cut(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random);

/// Fresh draws and a fresh pick of the variant for a gene that has any, chosen uniformly. Slots that the new variant
/// lacks are cut, required ones that it gains are grown.
bool alter(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random);

enum class Compatibility : std::uint8_t {
  edge,    // 2017: two filled slots of one edge
  symbol,  // 2016: the same child rule in any slot, or an empty slot that takes it
};

struct CrossoverSettings {
  Compatibility compatibility = Compatibility::edge;
  int retries = 3;                // attempts in all, >= 1
  double replace_probability = 1;  // symbol: chance that a match beside an empty slot is replaced rather than added
};

struct CrossoverResult {
  bool crossed = false;  // false: the children are copies of their parents
  int tries = 0;
};

/// Swaps a random subtree of parent 1 with a random compatible one of parent 2. Genes are conserved: together the
/// children hold exactly the parents' genes. The children must not alias the parents; their storage is reused.
CrossoverResult crossover(const GeneratorGraph& graph, const Derivation& parent1, const Derivation& parent2,
                          const Locks& locks1, const Locks& locks2, const CrossoverSettings& settings,
                          RandomStream& random, Derivation& child1, Derivation& child2);

}  // namespace espalier
