#include "breed/draw_locks.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/lock_map.h"
#include "derivation/position.h"

namespace espalier {
namespace {

/// The rule that a path leads to. Throws Error.
const Rule& rule_at(const GeneratorGraph& graph, const std::vector<std::uint16_t>& path) {
  const Rule* rule = &graph.rules[graph.start()];
  for (const std::uint16_t slot : path) {
    if (slot >= rule->slots.size()) {
      throw Error(fmt::format("lock: rule {} has {} slots, there is no slot {}", rule->name, rule->slots.size(), slot));
    }
    rule = &graph.rule_of(rule->slots[slot].edge);
  }
  return *rule;
}

}  // namespace

void validate(const GeneratorGraph& graph, const Held& held) {
  for (const Lock& lock : held.genes) rule_at(graph, lock.path);
  for (const DrawLock& lock : held.draws) {
    const Rule& rule = rule_at(graph, lock.path);
    if (lock.draw >= rule.draws.size()) {
      throw Error(fmt::format("lock: rule {} has {} draws, there is no draw {}", rule.name, rule.draws.size(),
                              lock.draw));
    }
  }
}

std::int64_t find_draw(const GeneratorGraph& graph, const Derivation& derivation, const DrawLock& lock) {
  const std::optional<std::uint32_t> gene = find_gene(graph, derivation, lock.path);
  if (!gene) return -1;
  GenePath path;
  locate(graph, derivation, *gene, path);
  const std::vector<std::uint16_t>& draws = variant_of(graph, derivation.genes[*gene]).draws;
  const auto found = std::find(draws.begin(), draws.end(), lock.draw);
  return found == draws.end() ? -1 : path.gene.draw + (found - draws.begin());
}

std::vector<std::uint8_t> held_draws(const GeneratorGraph& graph, const Derivation& derivation, const Held& held) {
  std::vector<std::uint8_t> mask(derivation.draws.size());
  LockMap locks;
  locks.reset(graph, derivation, held.genes);
  std::size_t draw = 0;
  for (std::uint32_t gene = 0; gene < derivation.size(); ++gene) {
    const std::size_t count = variant_of(graph, derivation.genes[gene]).draws.size();
    if (locks.held(gene) & LockMap::kDraws) std::fill_n(mask.begin() + static_cast<std::ptrdiff_t>(draw), count, 1);
    draw += count;
  }
  for (const DrawLock& lock : held.draws) {
    const std::int64_t at = find_draw(graph, derivation, lock);
    if (at >= 0) mask[static_cast<std::size_t>(at)] = 1;
  }
  return mask;
}

void keep_held_draws(const GeneratorGraph& graph, const Derivation& from, const Held& held, Derivation& child) {
  for (const DrawLock& lock : held.draws) {
    const std::int64_t there = find_draw(graph, from, lock), here = find_draw(graph, child, lock);
    if (there < 0 || here < 0) continue;
    child.draws[static_cast<std::size_t>(here)] = from.draws[static_cast<std::size_t>(there)];
  }
}

}  // namespace espalier
