#pragma once
// What breeding must leave alone: whole genes (derivation/locks.h), and single draws of them. A child has its first
// parent's values of all that is held.

#include <cstdint>
#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "derivation/locks.h"

namespace espalier {

/// One draw of the gene that a path leads to. Where no such gene stands, or its variant lacks the draw, it holds
/// nothing.
struct DrawLock {
  std::vector<std::uint16_t> path;  // rule-slot indices from the start gene
  std::uint16_t draw = 0;           // index into Rule::draws

  bool operator==(const DrawLock&) const = default;
};

struct Held {
  Locks genes;
  std::vector<DrawLock> draws;

  bool empty() const { return genes.empty() && draws.empty(); }
};

/// Throws Error naming the lock that leads to no place of the graph.
void validate(const GeneratorGraph& graph, const Held& held);

/// Index into Derivation::draws of what a draw lock holds there; nothing (-1) where it holds nothing.
std::int64_t find_draw(const GeneratorGraph& graph, const Derivation& derivation, const DrawLock& lock);

/// Per draw of the derivation: whether a draw lock or a gene lock holds it.
std::vector<std::uint8_t> held_draws(const GeneratorGraph& graph, const Derivation& derivation, const Held& held);

/// Gives the child the values that `from` has in held draws, wherever both have them.
void keep_held_draws(const GeneratorGraph& graph, const Derivation& from, const Held& held, Derivation& child);

}  // namespace espalier
