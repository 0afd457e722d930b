#include "derivation/crossover.h"

#include <optional>

#include "base/check.h"
#include "derivation/chances.h"
#include "derivation/limits.h"
#include "derivation/lock_map.h"
#include "derivation/refit.h"
#include "derivation/splice.h"

namespace espalier {
namespace {

/// One parent, and the place in it where the swap happens.
struct Side {
  const Derivation* parent = nullptr;
  LockMap locks;
  LimitLedger ledger, after;       // of the parent, and of its child
  GenePath path;                   // to the top gene of the slice, or to where it would stand
  SubtreeSlice slice;              // what goes; length 0: an empty slot
  EdgeId edge = 0;                 // of the slot
  std::vector<SlotPatch> patches;  // to the slice, where it comes to stand

  std::uint32_t size() const { return static_cast<std::uint32_t>(parent->size()); }
  std::size_t slot() const { return path.steps.back().gene.slot + path.steps.back().slot; }
};

/// A place in parent 2.
struct Target {
  static constexpr std::uint32_t kFilled = 0xffffffff;
  std::uint32_t gene = 0;        // the one to be swapped; of an empty slot, its owner
  std::uint32_t slot = kFilled;  // the empty slot: index into the variant's slots
};

class Swapper {
 public:
  void begin(const GeneratorGraph& graph, const Derivation& parent1, const Derivation& parent2, const Locks& locks1,
             const Locks& locks2, const CrossoverSettings& settings);
  /// Picks a gene of parent 1. False if none may go.
  bool pick_giver(RandomStream& random);
  /// Picks a compatible place in parent 2. False if there is none.
  bool pick_target(RandomStream& random);
  void swap(Derivation& child1, Derivation& child2) const;

 private:
  std::uint32_t pick_match(RandomStream& random) const;
  void collect_same_edge();
  void collect_same_rule(RandomStream& random);
  void collect_slots(std::uint32_t gene, std::size_t slots, RandomStream& random);
  bool compatible(const Target& target);
  void locate_target(const Target& target);
  bool limits_hold();
  bool guards_hold();

  const GeneratorGraph* graph_ = nullptr;
  CrossoverSettings settings_;
  Side side1_, side2_;
  RuleId rule_ = 0;  // of the giver
  std::optional<bool> depends_on_depth_;
  std::vector<Target> targets_;
  GeneSweep sweep_;
};

void Swapper::begin(const GeneratorGraph& graph, const Derivation& parent1, const Derivation& parent2,
                    const Locks& locks1, const Locks& locks2, const CrossoverSettings& settings) {
  graph_ = &graph;
  settings_ = settings;
  side1_.parent = &parent1;
  side2_.parent = &parent2;
  side1_.locks.reset(graph, parent1, locks1);
  side2_.locks.reset(graph, parent2, locks2);
  side1_.ledger.reset(graph, parent1);
  side2_.ledger.reset(graph, parent2);
  depends_on_depth_.reset();
}

bool Swapper::pick_giver(RandomStream& random) {
  std::uint32_t gene = 0;
  if (side1_.locks.free()) {
    if (side1_.size() < 2) return false;
    gene = 1 + random.below(side1_.size() - 1);
  } else {
    targets_.clear();
    for (std::uint32_t g = 1; g < side1_.size(); ++g) {
      if (!side1_.locks.pinned(g)) targets_.push_back({g});
    }
    if (targets_.empty()) return false;
    gene = targets_[random.below(static_cast<std::uint32_t>(targets_.size()))].gene;
  }
  locate(*graph_, *side1_.parent, gene, side1_.path);
  side1_.slice = subtree_at(*graph_, *side1_.parent, side1_.path.gene);
  side1_.edge = side1_.parent->genes[gene].edge;
  rule_ = graph_->edges[side1_.edge].child;
  return true;
}

/// A gene of parent 2 with the giver's edge, picked uniformly; 0 if there is none.
std::uint32_t Swapper::pick_match(RandomStream& random) const {
  const std::vector<GeneRecord>& genes = side2_.parent->genes;
  // Where matches are common, picking any gene until one matches is much cheaper than a scan, and uniform too.
  for (std::uint32_t guess = 0; guess < side2_.size() / 32; ++guess) {
    const std::uint32_t gene = random.below(side2_.size());
    if (genes[gene].edge == side1_.edge) return gene;
  }
  std::uint32_t matches = 0;
  for (const GeneRecord& gene : genes) matches += gene.edge == side1_.edge;
  if (matches == 0) return 0;
  std::uint32_t skip = random.below(matches);
  for (std::uint32_t gene = 1;; ++gene) {
    if (genes[gene].edge == side1_.edge && skip-- == 0) return gene;
  }
}

void Swapper::collect_same_edge() {
  targets_.clear();
  for (std::uint32_t g = 1; g < side2_.size(); ++g) {
    if (side2_.parent->genes[g].edge == side1_.edge && !side2_.locks.pinned(g)) targets_.push_back({g});
  }
}

void Swapper::collect_same_rule(RandomStream& random) {
  targets_.clear();
  std::size_t slots = 0;  // where the gene's own begin
  for (std::uint32_t g = 0; g < side2_.size(); ++g) {
    collect_slots(g, slots, random);
    slots += variant_of(*graph_, side2_.parent->genes[g]).slots.size();
  }
}

/// The places among the slots of one gene of parent 2.
void Swapper::collect_slots(std::uint32_t gene, std::size_t slots, RandomStream& random) {
  const std::vector<GeneRecord>& genes = side2_.parent->genes;
  const Rule& rule = rule_of(*graph_, genes[gene]);
  const std::vector<std::uint16_t>& own = rule.variants[genes[gene].variant].slots;
  const bool may_add = !graph_->edges[side1_.edge].required && !(side2_.locks.held(gene) & LockMap::kSlots);
  const auto takes = [&](std::size_t k) {
    return may_add && side2_.parent->slots[slots + k] == SlotState::empty &&
           graph_->edges[rule.slots[own[k]].edge].child == rule_;
  };
  bool beside_empty = false;
  for (std::size_t k = 0; k < own.size() && !beside_empty; ++k) beside_empty = takes(k);
  std::uint32_t child = gene + 1;
  for (std::uint32_t k = 0; k < own.size(); ++k) {
    if (takes(k)) targets_.push_back({gene, k});
    if (side2_.parent->slots[slots + k] != SlotState::filled) continue;
    const std::uint32_t here = child;
    child += 1 + genes[child].genes_below;
    if (graph_->edges[genes[here].edge].child != rule_ || side2_.locks.pinned(here)) continue;
    const bool always = !beside_empty || settings_.replace_probability >= 1;
    if (always || random.chance(settings_.replace_probability)) targets_.push_back({here});
  }
}

void Swapper::locate_target(const Target& target) {
  const Derivation& parent = *side2_.parent;
  locate(*graph_, parent, target.gene, side2_.path);
  if (target.slot == Target::kFilled) {
    side2_.slice = subtree_at(*graph_, parent, side2_.path.gene);
    side2_.edge = parent.genes[target.gene].edge;
    return;
  }
  const GenePosition owner = side2_.path.gene;
  const Rule& rule = rule_of(*graph_, parent.genes[target.gene]);
  side2_.edge = rule.slots[variant_of(*graph_, parent.genes[target.gene]).slots[target.slot]].edge;
  side2_.path.gene = child_in_slot(*graph_, parent, owner, target.slot);
  side2_.path.steps.push_back({owner, target.slot});
  side2_.path.above.enter(rule);
  side2_.slice = {side2_.path.gene, 0, 0, 0};
}

bool Swapper::limits_hold() {
  if (!side1_.ledger.active()) return true;
  side1_.after = side1_.ledger;
  side1_.after.remove(*graph_, *side1_.parent, side1_.slice);
  side1_.after.add(*graph_, *side2_.parent, side2_.slice);
  side2_.after = side2_.ledger;
  side2_.after.remove(*graph_, *side2_.parent, side2_.slice);
  side2_.after.add(*graph_, *side1_.parent, side1_.slice);
  return side1_.after.holds() && side2_.after.holds();
}

bool Swapper::guards_hold() {
  side1_.patches.clear();
  side2_.patches.clear();
  const DepthCounts above1 = side1_.path.above.counts(), above2 = side2_.path.above.counts();
  if (above1 == above2) return true;
  if (!depends_on_depth_) depends_on_depth_ = depends_on_depth(*graph_);
  if (!*depends_on_depth_) return true;
  if (!refit(*graph_, *side1_.parent, side1_.path.gene, above2, sweep_, side1_.patches)) return false;
  return side2_.slice.genes == 0 ||
         refit(*graph_, *side2_.parent, side2_.path.gene, above1, sweep_, side2_.patches);
}

bool Swapper::compatible(const Target& target) {
  locate_target(target);
  if (side2_.slice.genes == 0) {  // an empty slot may have come to have probability 0
    const Rule& owner = rule_of(*graph_, side2_.parent->genes[target.gene]);
    side2_.path.above.leave(owner);
    const double p = fill_probability(graph_->edges[side2_.edge], side2_.path.above.counts());
    side2_.path.above.enter(owner);
    if (p <= 0) return false;
  }
  return limits_hold() && guards_hold();
}

bool Swapper::pick_target(RandomStream& random) {
  constexpr int kMostPicks = 64;
  int picks = 0;
  if (settings_.compatibility == Compatibility::symbol) {
    collect_same_rule(random);
  } else if (!side2_.locks.free()) {
    collect_same_edge();
  } else {
    // A few picks with replacement nearly always find one that fits, so no list is made.
    constexpr int kQuickPicks = 8;
    for (; picks < kQuickPicks; ++picks) {
      const std::uint32_t match = pick_match(random);
      if (match == 0) return false;
      if (compatible({match})) return true;
    }
    collect_same_edge();
  }
  for (; picks < kMostPicks && !targets_.empty(); ++picks) {
    const std::uint32_t k = random.below(static_cast<std::uint32_t>(targets_.size()));
    if (compatible(targets_[k])) return true;
    targets_[k] = targets_.back();
    targets_.pop_back();
  }
  return false;
}

/// child = the host's parent with the giver's slice in the host's place.
void put(const Side& host, const Side& giver, Derivation& child) {
  splice(*host.parent, host.slice, *giver.parent, giver.slice, host.path.steps, child);
  child.slots[host.slot()] = giver.slice.genes > 0 ? SlotState::filled : SlotState::empty;
  if (giver.slice.genes > 0) child.genes[host.slice.begin.gene].edge = host.edge;
  for (const SlotPatch& patch : giver.patches) child.slots[host.slice.begin.slot + patch.slot] = patch.state;
}

void Swapper::swap(Derivation& child1, Derivation& child2) const {
  put(side1_, side2_, child1);
  put(side2_, side1_, child2);
}

}  // namespace

CrossoverResult crossover(const GeneratorGraph& graph, const Derivation& parent1, const Derivation& parent2,
                          const Locks& locks1, const Locks& locks2, const CrossoverSettings& settings,
                          RandomStream& random, Derivation& child1, Derivation& child2) {
  CHECK(&child1 != &parent1 && &child1 != &parent2 && &child2 != &parent1 && &child2 != &parent2 && &child1 != &child2);
  CHECK(settings.retries >= 1);
  static thread_local Swapper swapper;
  swapper.begin(graph, parent1, parent2, locks1, locks2, settings);
  CrossoverResult result;
  while (result.tries < settings.retries && swapper.pick_giver(random)) {
    ++result.tries;
    if (!swapper.pick_target(random)) continue;
    swapper.swap(child1, child2);
    result.crossed = true;
    return result;
  }
  child1 = parent1;
  child2 = parent2;
  return result;
}

}  // namespace espalier
