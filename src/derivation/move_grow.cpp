#include "derivation/chances.h"
#include "derivation/growth.h"
#include "derivation/lock_map.h"
#include "derivation/moves.h"
#include "derivation/pick.h"
#include "derivation/splice.h"
#include "derivation/sweep.h"

namespace espalier {
namespace {

struct Candidate {
  std::uint32_t gene = 0;
  std::uint32_t slot = 0;  // index into the variant's slots
  double weight = 0;
};

struct Workspace {
  GeneSweep sweep;
  LockMap locks;
  LimitLedger ledger, attempt;
  GenePath path;
  Growth growth;
  Derivation grown;
  std::vector<Candidate> candidates;
};

double find_empty_slots(const GeneratorGraph& graph, const Derivation& derivation, Workspace& work) {
  double total = 0;
  work.candidates.clear();
  work.sweep.begin(graph, derivation);
  while (work.sweep.next()) {
    const std::uint32_t gene = work.sweep.position().gene;
    if (work.locks.held(gene) & LockMap::kSlots) continue;
    for (std::uint32_t k = 0; k < work.sweep.variant().slots.size(); ++k) {
      if (work.sweep.slot(k) != SlotState::empty) continue;
      const Edge& edge = graph.edges[work.sweep.slot_of_rule(k).edge];
      const double weight = fill_probability(edge, work.sweep.above());
      if (weight <= 0 || !work.ledger.has_room(edge.child)) continue;
      total += weight;
      work.candidates.push_back({gene, k, weight});
    }
  }
  return total;
}

}  // namespace

bool grow(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random) {
  static thread_local Workspace work;
  work.locks.reset(graph, derivation, locks);
  work.ledger.reset(graph, derivation);
  const double total = find_empty_slots(graph, derivation, work);
  if (work.candidates.empty()) return false;
  constexpr int kMostTries = 100;
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    const Candidate& place = work.candidates[pick_weighted(work.candidates, total, random)];
    locate(graph, derivation, place.gene, work.path);
    const Rule& rule = rule_of(graph, derivation.genes[place.gene]);
    const Variant& variant = variant_of(graph, derivation.genes[place.gene]);
    work.path.above.enter(rule);
    work.attempt = work.ledger;
    work.grown.genes.clear(), work.grown.slots.clear(), work.grown.draws.clear();
    const EdgeId edge = rule.slots[variant.slots[place.slot]].edge;
    const GrowthFault fault =
        work.growth.append(graph, edge, work.path.above.counts(), random, work.attempt, work.grown);
    if (fault != GrowthFault::none) continue;
    const GenePosition child = child_in_slot(graph, derivation, work.path.gene, place.slot);
    work.path.steps.push_back({work.path.gene, place.slot});
    splice_in_place(derivation, {child, 0, 0, 0}, work.grown, whole(work.grown), work.path.steps);
    derivation.slots[work.path.gene.slot + place.slot] = SlotState::filled;
    return true;
  }
  return false;
}

}  // namespace espalier
