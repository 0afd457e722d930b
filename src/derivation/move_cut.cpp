#include "derivation/chances.h"
#include "derivation/lock_map.h"
#include "derivation/moves.h"
#include "derivation/pick.h"
#include "derivation/splice.h"
#include "derivation/sweep.h"

namespace espalier {
namespace {

struct Candidate {
  std::uint32_t gene = 0;
  double weight = 0;
};

struct Workspace {
  GeneSweep sweep;
  LockMap locks;
  GenePath path;
  std::vector<Candidate> candidates;
  Derivation nothing;
};

/// The weight of a child is known where its parent stands, before the sweep comes to the child: so the candidates are
/// found slot by slot.
double find_optional_children(const GeneratorGraph& graph, const Derivation& derivation, Workspace& work) {
  double total = 0;
  work.candidates.clear();
  work.sweep.begin(graph, derivation);
  while (work.sweep.next()) {
    const GenePosition& parent = work.sweep.position();
    for_each_child(graph, derivation, parent, [&](std::uint32_t slot, const GenePosition& child) {
      const Edge& edge = graph.edges[work.sweep.slot_of_rule(slot).edge];
      if (edge.required || work.locks.pinned(child.gene)) return;
      const double weight = 1 - fill_probability(edge, work.sweep.above());
      if (weight <= 0) return;
      total += weight;
      work.candidates.push_back({child.gene, weight});
    });
  }
  return total;
}

}  // namespace

bool cut(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random) {
  static thread_local Workspace work;
  work.locks.reset(graph, derivation, locks);
  const double total = find_optional_children(graph, derivation, work);
  if (work.candidates.empty()) return false;
  const Candidate& picked = work.candidates[pick_weighted(work.candidates, total, random)];
  locate(graph, derivation, picked.gene, work.path);
  const PathStep parent = work.path.steps.back();
  splice_in_place(derivation, subtree_at(graph, derivation, work.path.gene), work.nothing, {}, work.path.steps);
  derivation.slots[parent.gene.slot + parent.slot] = SlotState::empty;
  return true;
}

}  // namespace espalier
