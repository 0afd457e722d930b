#pragma once
// Derivations and locks at random, and what locks promise.

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/locks.h"
#include "derivation/moves.h"
#include "derivation/position.h"
#include "derivation/sample.h"
#include "random_graph.h"

namespace espalier::test {

inline RandomStream stream(std::uint64_t seed) { return RandomStream({seed, Purpose::test}); }

/// A sample of the prior, or nothing where the limits of a random graph leave none. Sometimes with open slots.
inline std::optional<Derivation> random_derivation(const GeneratorGraph& graph, RandomStream& random,
                                                   std::uint32_t most_genes = 60) {
  try {
    Derivation derivation = sample(graph, random, most_genes).derivation;
    if (random.chance(0.7) && !close_open_slots(graph, derivation, random)) return std::nullopt;
    return derivation;
  } catch (const Error&) {
    return std::nullopt;
  }
}

inline Locks random_locks(const GeneratorGraph& graph, const Derivation& derivation, RandomStream& random) {
  Locks locks;
  for (std::uint32_t n = random.below(3); n > 0; --n) {
    const std::uint32_t gene = random.below(static_cast<std::uint32_t>(derivation.size()));
    locks.push_back({gene_path(graph, derivation, gene), static_cast<LockScope>(random.below(3))});
  }
  if (random.chance(0.1)) locks.push_back({{65535}, LockScope::subtree});  // leads nowhere
  return locks;
}

inline GenePosition place_of(const GeneratorGraph& graph, const Derivation& derivation, std::uint32_t gene) {
  GenePath path;
  locate(graph, derivation, gene, path);
  return path.gene;
}

template <class T>
bool equal_run(const std::vector<T>& a, std::size_t from_a, const std::vector<T>& b, std::size_t from_b,
               std::size_t n) {
  return from_b + n <= b.size() && std::equal(a.begin() + from_a, a.begin() + from_a + n, b.begin() + from_b);
}

/// What each lock holds in `before` is the same in `after`.
inline void expect_locks_kept(const GeneratorGraph& graph, const Derivation& before, const Derivation& after,
                              const Locks& locks) {
  for (const Lock& lock : locks) {
    const std::optional<std::uint32_t> old_gene = find_gene(graph, before, lock.path);
    if (!old_gene) continue;
    const std::optional<std::uint32_t> new_gene = find_gene(graph, after, lock.path);
    ASSERT_TRUE(new_gene.has_value()) << "the locked gene has gone";
    const SubtreeSlice a = subtree_at(graph, before, place_of(graph, before, *old_gene));
    const SubtreeSlice b = subtree_at(graph, after, place_of(graph, after, *new_gene));
    const GeneRecord& old_record = before.genes[*old_gene];
    EXPECT_EQ(old_record.edge, after.genes[*new_gene].edge);
    EXPECT_EQ(old_record.variant, after.genes[*new_gene].variant);
    if (lock.scope != LockScope::structure) {
      const std::size_t own = variant_of(graph, old_record).draws.size();
      const std::size_t n = lock.scope == LockScope::subtree ? a.draws : own;
      EXPECT_TRUE(equal_run(before.draws, a.begin.draw, after.draws, b.begin.draw, n));
    }
    if (lock.scope != LockScope::draws) {
      EXPECT_TRUE(equal_run(before.genes, a.begin.gene, after.genes, b.begin.gene, a.genes));
      EXPECT_TRUE(equal_run(before.slots, a.begin.slot, after.slots, b.begin.slot, a.slots));
    }
  }
}

}  // namespace espalier::test
