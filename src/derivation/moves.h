#pragma once
// Moves: what changes a derivation. Each is a free function of (graph, derivation, locks, random stream), works in
// place and returns false, leaving the derivation untouched, when no such move exists. Every result is a valid
// derivation of the graph (find_fault), and all that the locks hold stays. The detail seed stays too. Open slots are
// left alone. Linear time. ShapeGenetics 2017, section 5; language.md 11.
//
// Random contents may break a `limit` or find no end (100 000 genes): place and contents are then drawn again together,
// so each move has the distribution that its comment gives, conditioned on being valid. After 100 draws it counts as
// not existing.

#include "base/random.h"
#include "derivation/crossover.h"
#include "derivation/derivation.h"
#include "derivation/locks.h"

namespace espalier {

/// Fills an empty slot, chosen with probability proportional to its p. Variant and draws are fresh; required slots
/// below are grown, optional ones stay empty. Slots whose rule has reached its limit do not count.
bool grow(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random);

/// Empties a filled optional slot, chosen with probability proportional to 1 - p, with all that stands on it.
bool cut(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random);

/// Fresh draws and a fresh pick of the variant for a gene that has any (its rule has several variants, or its variant
/// has draws), chosen uniformly; the start gene may be. Slots that both variants have keep their children; those that
/// the new variant lacks are cut; of those that it gains, required ones are grown and optional ones are empty. Where
/// locks hold the variant, it stays; where they hold a child, only variants that have its slot are picked from.
bool alter(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random);

}  // namespace espalier
