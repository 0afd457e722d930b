#pragma once
// What grows in a pool, packed the plain way: slot by slot, looking through all shoots for the one that stands there.

#include <vector>

#include <gtest/gtest.h>

#include "derivation/growth_pool.h"

namespace espalier::test {

/// Place in the history of the gene that has the bud.
inline std::uint32_t owner_in(const GrowthPool& pool, const std::vector<ShootId>& history, BudId bud) {
  for (std::uint32_t i = 0; i < history.size(); ++i) {
    const GrowthPool::Shoot& shoot = pool.shoot(history[i]);
    if (!shoot.filled) continue;
    if (bud >= shoot.first_bud && bud < shoot.first_bud + pool.variant_of(shoot).slots.size()) return i;
  }
  ADD_FAILURE() << "nobody has bud " << bud;
  return 0;
}

inline void plain_pack(const GeneratorGraph& graph, const GrowthPool& pool, const std::vector<ShootId>& history,
                       const GrowthPool::Shoot& shoot, Derivation& out) {
  const std::size_t self = out.genes.size();
  const Rule& rule = graph.rules[graph.edges[shoot.edge].child];
  const Variant& variant = rule.variants[shoot.variant];
  out.genes.push_back({shoot.edge, shoot.variant, 0, 0, 0});
  out.draws.insert(out.draws.end(), pool.draws(shoot), pool.draws(shoot) + variant.draws.size());
  const std::size_t draws = out.draws.size();
  std::vector<const GrowthPool::Shoot*> children;
  for (std::uint32_t k = 0; k < variant.slots.size(); ++k) {
    SlotState state = pool.bud(shoot.first_bud + k).absent ? SlotState::absent : SlotState::open;
    for (const ShootId id : history) {
      const GrowthPool::Shoot& child = pool.shoot(id);
      if (child.bud != shoot.first_bud + k) continue;
      EXPECT_EQ(state, SlotState::open) << "decided twice, or absent";
      state = child.filled ? SlotState::filled : SlotState::empty;
      if (child.filled) children.push_back(&child);
    }
    out.slots.push_back(state);
  }
  const std::size_t below = out.slots.size();
  for (const GrowthPool::Shoot* child : children) plain_pack(graph, pool, history, *child, out);
  out.genes[self].genes_below = static_cast<std::uint32_t>(out.genes.size() - self - 1);
  out.genes[self].slots_below = static_cast<std::uint32_t>(out.slots.size() - below);
  out.genes[self].draws_below = static_cast<std::uint32_t>(out.draws.size() - draws);
}

/// Of just these shoots.
inline Derivation plain_pack(const GeneratorGraph& graph, const GrowthPool& pool, const std::vector<ShootId>& history,
                             std::uint64_t detail_seed) {
  Derivation out;
  out.detail_seed = detail_seed;
  plain_pack(graph, pool, history, pool.shoot(history.front()), out);
  return out;
}

inline Derivation plain_pack(const GeneratorGraph& graph, const GrowthPool& pool, const GrowingDerivation& growing) {
  std::vector<ShootId> history;
  pool.history(growing, history);
  return plain_pack(graph, pool, history, growing.detail_seed);
}

}  // namespace espalier::test
