#pragma once
// Newcomers: members that are nobody's children.

#include "base/random.h"
#include "breed/draw_locks.h"
#include "derivation/derivation.h"

namespace espalier {

inline constexpr std::uint32_t kMostNewcomerGenes = 2000;
inline constexpr std::uint32_t kShortestNewcomer = 8, kLongestGrown = 40;

/// A finished derivation drawn from the grammar; growth of optional slots ends at kMostNewcomerGenes.
/// Where it has fewer genes than a number drawn between kShortestNewcomer and kLongestGrown, it grows on by moves
/// (derivation/moves.h), as first individuals of searches do. Throws Error where
/// required slots have no end.
Derivation draw_newcomer(const GeneratorGraph& graph, RandomStream& random);

/// The same, but all that is held is as `host` has it.
Derivation draw_newcomer(const GeneratorGraph& graph, const Derivation& host, const Held& held, RandomStream& random);

}  // namespace espalier
