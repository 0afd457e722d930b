#include <algorithm>

#include "derivation/chances.h"
#include "derivation/growth.h"
#include "derivation/lock_map.h"
#include "derivation/moves.h"
#include "derivation/splice.h"

namespace espalier {
namespace {

struct Workspace {
  LockMap locks;
  LimitLedger ledger, attempt;
  GenePath path;
  Growth growth;
  TreeWriter writer;
  DepthCounter below;
  Derivation altered;
  std::vector<std::uint32_t> candidates;
  std::vector<std::uint8_t> allowed;
};

void find_alterable(const GeneratorGraph& graph, const Derivation& derivation, Workspace& work) {
  work.candidates.clear();
  for (std::uint32_t g = 0; g < derivation.size(); ++g) {
    const Rule& rule = rule_of(graph, derivation.genes[g]);
    const std::uint8_t held = work.locks.held(g);
    const bool variants = rule.variants.size() > 1 && !(held & LockMap::kVariant);
    const bool draws = !rule.variants[derivation.genes[g].variant].draws.empty() && !(held & LockMap::kDraws);
    if (variants || draws) work.candidates.push_back(g);
  }
}

bool has_slot(const Variant& variant, std::uint16_t slot) {
  return std::binary_search(variant.slots.begin(), variant.slots.end(), slot);
}

/// A fresh variant for the gene at work.path, among those that keep what locks hold.
std::optional<std::uint16_t> repick_variant(const GeneratorGraph& graph, const Derivation& derivation, Workspace& work,
                                            RandomStream& random) {
  const GeneRecord& record = derivation.genes[work.path.gene.gene];
  if (work.locks.held(work.path.gene.gene) & LockMap::kVariant) return record.variant;
  const Rule& rule = rule_of(graph, record);
  work.allowed.assign(rule.variants.size(), 1);
  for_each_child(graph, derivation, work.path.gene, [&](std::uint32_t slot, const GenePosition& child) {
    if (!work.locks.pinned(child.gene)) return;
    for (std::size_t v = 0; v < rule.variants.size(); ++v) {
      if (!has_slot(rule.variants[v], rule.variants[record.variant].slots[slot])) work.allowed[v] = 0;
    }
  });
  return pick_variant(rule, work.path.above.counts(), random, work.allowed);
}

/// Index of a rule's slot among the variant's, or its number of slots.
std::size_t index_of(const Variant& variant, std::uint16_t slot) {
  const auto found = std::lower_bound(variant.slots.begin(), variant.slots.end(), slot);
  return found != variant.slots.end() && *found == slot ? found - variant.slots.begin() : variant.slots.size();
}

/// Writes the gene's own slots as they are under the new variant; gained required ones as filled.
void write_slots(const GeneratorGraph& graph, const Derivation& derivation, const Rule& rule, const Variant& before,
                 const Variant& after, Workspace& work) {
  for (const std::uint16_t s : after.slots) {
    const std::size_t k = index_of(before, s);
    const EdgeId edge = rule.slots[s].edge;
    SlotState state = graph.edges[edge].required ? SlotState::filled : SlotState::empty;
    if (!may_stand(graph, edge, work.below.counts())) state = SlotState::absent;
    if (k < before.slots.size()) state = derivation.slots[work.path.gene.slot + k];
    work.altered.slots.push_back(state);
  }
}

/// Writes the gene with its new variant, and what stands on it, to work.altered.
GrowthFault write_altered(const GeneratorGraph& graph, const Derivation& derivation, std::uint16_t picked,
                          Workspace& work, RandomStream& random) {
  const GeneRecord& record = derivation.genes[work.path.gene.gene];
  const Rule& rule = rule_of(graph, record);
  const Variant& before = rule.variants[record.variant];
  const Variant& after = rule.variants[picked];
  work.attempt = work.ledger;
  for_each_child(graph, derivation, work.path.gene, [&](std::uint32_t slot, const GenePosition& child) {
    if (has_slot(after, before.slots[slot])) return;
    work.attempt.remove(graph, derivation, subtree_at(graph, derivation, child));
  });
  work.below = work.path.above;
  work.below.enter(rule);
  work.altered.genes.clear(), work.altered.slots.clear(), work.altered.draws.clear();
  work.writer.begin(work.altered);
  work.writer.open(record.edge, picked);
  write_slots(graph, derivation, rule, before, after, work);
  append_draws(after, random, work.altered.draws);
  work.writer.opened();
  for (std::size_t k = 0; k < after.slots.size(); ++k) {
    if (work.altered.slots[k] != SlotState::filled) continue;
    const std::size_t old = index_of(before, after.slots[k]);
    if (old < before.slots.size()) {
      const GenePosition child = child_in_slot(graph, derivation, work.path.gene, static_cast<std::uint32_t>(old));
      work.writer.append(derivation, subtree_at(graph, derivation, child));
      continue;
    }
    const EdgeId edge = rule.slots[after.slots[k]].edge;
    const GrowthFault fault =
        work.growth.append(graph, edge, work.below.counts(), random, work.attempt, work.altered);
    if (fault != GrowthFault::none) return fault;
  }
  work.writer.close();
  return GrowthFault::none;
}

}  // namespace

bool alter(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random) {
  static thread_local Workspace work;
  work.locks.reset(graph, derivation, locks);
  find_alterable(graph, derivation, work);
  if (work.candidates.empty()) return false;
  work.ledger.reset(graph, derivation);
  constexpr int kMostTries = 100;
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    const std::uint32_t gene = work.candidates[random.below(static_cast<std::uint32_t>(work.candidates.size()))];
    locate(graph, derivation, gene, work.path);
    const std::optional<std::uint16_t> picked = repick_variant(graph, derivation, work, random);
    if (!picked) continue;
    if (*picked == derivation.genes[gene].variant) {
      const std::size_t draws = variant_of(graph, derivation.genes[gene]).draws.size();
      for (std::size_t k = 0; k < draws; ++k) derivation.draws[work.path.gene.draw + k] = random.next_u32();
      return true;
    }
    if (write_altered(graph, derivation, *picked, work, random) != GrowthFault::none) continue;
    splice_in_place(derivation, subtree_at(graph, derivation, work.path.gene), work.altered, whole(work.altered),
                    work.path.steps);
    return true;
  }
  return false;
}

}  // namespace espalier
