#include "derivation/proposal.h"

#include <algorithm>
#include <vector>

#include "base/natural_log.h"
#include "derivation/chances.h"
#include "derivation/growth.h"
#include "derivation/lock_map.h"
#include "derivation/nudge.h"
#include "derivation/splice.h"
#include "derivation/sweep.h"

namespace espalier {
namespace {

struct Place {
  std::uint32_t gene = 0;
  std::uint32_t slot = 0;  // index into the variant's slots; jumps and draws: 0
  std::uint32_t level = 0;

  bool is(const Place& other) const { return gene == other.gene && slot == other.slot; }
};

/// The places where a proposal may be made, and the chance that each is chosen.
class Places {
 public:
  void clear() {
    all_.clear();
    of_level_.clear();
  }
  void add(const Place& place) {
    if (place.level >= of_level_.size()) of_level_.resize(place.level + 1, 0);
    ++of_level_[place.level];
    all_.push_back(place);
  }
  bool empty() const { return all_.empty(); }
  bool contains(const Place& place) const {
    return std::any_of(all_.begin(), all_.end(), [&](const Place& one) { return one.is(place); });
  }
  const Place& choose(PlaceChoice choice, RandomStream& random) const {
    if (choice == PlaceChoice::uniform) return all_[random.below(static_cast<std::uint32_t>(all_.size()))];
    std::uint32_t nth_level = random.below(levels()), level = 0;
    while (of_level_[level] == 0 || nth_level-- > 0) ++level;
    std::uint32_t nth = random.below(of_level_[level]);
    std::size_t i = 0;
    while (all_[i].level != level || nth-- > 0) ++i;
    return all_[i];
  }
  /// log of the chance that `choose` gives this place.
  double log_chance(PlaceChoice choice, const Place& place) const {
    const double n = choice == PlaceChoice::uniform ? static_cast<double>(all_.size())
                                                    : static_cast<double>(levels()) * of_level_[place.level];
    return -natural_log(n);
  }

 private:
  std::uint32_t levels() const {
    return static_cast<std::uint32_t>(
        std::count_if(of_level_.begin(), of_level_.end(), [](std::uint32_t n) { return n > 0; }));
  }

  std::vector<Place> all_;
  std::vector<std::uint32_t> of_level_;
};

struct Workspace {
  GeneSweep sweep;
  LockMap locks;
  LimitLedger ledger;
  GenePath path;
  Growth growth;
  Places before, after;
  Derivation fresh;
  std::vector<std::pair<GenePosition, GenePosition>> pairs;
};

Workspace& workspace() {
  static thread_local Workspace work;
  return work;
}

enum class Kind : std::uint8_t { draws, jump, slot };

bool can_jump(const Rule& rule) {
  return rule.variants.size() > 1 || !rule.variants[0].slots.empty();
}

void find_places(const GeneratorGraph& graph, const Derivation& derivation, const Locks& locks, Kind kind,
                 Workspace& work, Places& places) {
  places.clear();
  work.locks.reset(graph, derivation, locks);
  work.sweep.begin(graph, derivation);
  while (work.sweep.next()) {
    const std::uint32_t gene = work.sweep.position().gene, level = work.sweep.above().depth;
    const std::uint8_t held = work.locks.held(gene);
    if (kind == Kind::draws) {
      if (!work.sweep.variant().draws.empty() && !(held & LockMap::kDraws)) places.add({gene, 0, level});
    } else if (kind == Kind::jump) {
      if (can_jump(work.sweep.rule()) && !(held & LockMap::kPinned)) places.add({gene, 0, level});
    } else if (!(held & LockMap::kSlots)) {
      std::uint32_t child = gene + 1;
      for (std::uint32_t k = 0; k < work.sweep.variant().slots.size(); ++k) {
        const SlotState state = work.sweep.slot(k);
        const bool filled = state == SlotState::filled;
        if (filled ? !work.locks.pinned(child) : state == SlotState::empty) places.add({gene, k, level});
        if (filled) child += 1 + derivation.genes[child].genes_below;
      }
    }
  }
}

/// Draws of genes that stand at equal slot paths with equal rules and variants are taken over from the old subtree.
void reuse_draws(const GeneratorGraph& graph, const Derivation& before, const GenePosition& old_top, Derivation& fresh,
                 Workspace& work) {
  work.pairs.assign(1, {old_top, GenePosition{}});
  while (!work.pairs.empty()) {
    const auto [old_gene, new_gene] = work.pairs.back();
    work.pairs.pop_back();
    const Variant& old_variant = variant_of(graph, before.genes[old_gene.gene]);
    const Variant& new_variant = variant_of(graph, fresh.genes[new_gene.gene]);
    if (&old_variant == &new_variant) {
      std::copy_n(before.draws.begin() + old_gene.draw, old_variant.draws.size(), fresh.draws.begin() + new_gene.draw);
    }
    for_each_child(graph, fresh, new_gene, [&](std::uint32_t k, const GenePosition& new_child) {
      const std::uint16_t slot = new_variant.slots[k];
      const auto found = std::lower_bound(old_variant.slots.begin(), old_variant.slots.end(), slot);
      if (found == old_variant.slots.end() || *found != slot) return;
      const auto old_k = static_cast<std::uint32_t>(found - old_variant.slots.begin());
      if (before.slots[old_gene.slot + old_k] != SlotState::filled) return;
      work.pairs.push_back({child_in_slot(graph, before, old_gene, old_k), new_child});
    });
  }
}

/// Chooses where the proposal is made; its gene is located in work.path. Nothing where there is no such place.
std::optional<Place> choose_place(const GeneratorGraph& graph, const Derivation& derivation, const Locks& locks,
                                  Kind kind, PlaceChoice choice, Workspace& work, RandomStream& random) {
  find_places(graph, derivation, locks, kind, work, work.before);
  if (work.before.empty()) return std::nullopt;
  const Place place = work.before.choose(choice, random);
  locate(graph, derivation, place.gene, work.path);
  return place;
}

/// Draws the subtree that stands in a slot of `edge` from the prior, to work.fresh. The ledger must not count the old.
bool draw_subtree(const GeneratorGraph& graph, EdgeId edge, const DepthCounts& above, std::uint32_t most_genes,
                  Workspace& work, RandomStream& random) {
  work.fresh.genes.clear(), work.fresh.slots.clear(), work.fresh.draws.clear();
  return most_genes > 0 && work.growth.append(graph, edge, above, random, work.ledger, work.fresh, most_genes,
                                              OptionalSlots::by_prior) == GrowthFault::none;
}

/// The rest of the ratio: the same place must be open to a proposal afterwards.
std::optional<double> ratio(const GeneratorGraph& graph, const Derivation& after, const Locks& locks, Kind kind,
                            PlaceChoice choice, const Place& place, Workspace& work) {
  find_places(graph, after, locks, kind, work, work.after);
  if (!work.after.contains(place)) return std::nullopt;
  return work.after.log_chance(choice, place) - work.before.log_chance(choice, place);
}

}  // namespace

std::optional<double> propose_draws(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks,
                                    PlaceChoice choice, DrawStep step, RandomStream& random,
                                    std::uint32_t* chosen) {
  Workspace& work = workspace();
  find_places(graph, derivation, locks, Kind::draws, work, work.before);
  if (work.before.empty()) return std::nullopt;
  const std::uint32_t gene = work.before.choose(choice, random).gene;
  if (chosen) *chosen = gene;
  if (step == DrawStep::local) {
    nudge_gene(graph, derivation, gene, random);
    return 0;
  }
  locate(graph, derivation, gene, work.path);
  const std::size_t draws = variant_of(graph, derivation.genes[gene]).draws.size();
  for (std::size_t k = 0; k < draws; ++k) derivation.draws[work.path.gene.draw + k] = random.next_u32();
  return 0;
}

std::optional<double> propose_jump(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks,
                                   PlaceChoice choice, std::uint32_t most_genes, RandomStream& random) {
  Workspace& work = workspace();
  const std::optional<Place> place = choose_place(graph, derivation, locks, Kind::jump, choice, work, random);
  if (!place) return std::nullopt;
  const SubtreeSlice old = subtree_at(graph, derivation, work.path.gene);
  const std::size_t rest = derivation.size() - old.genes;
  if (rest >= most_genes) return std::nullopt;
  work.ledger.reset(graph, derivation);
  work.ledger.remove(graph, derivation, old);
  const EdgeId edge = derivation.genes[place->gene].edge;
  if (!draw_subtree(graph, edge, work.path.above.counts(), static_cast<std::uint32_t>(most_genes - rest), work,
                    random)) {
    return std::nullopt;
  }
  reuse_draws(graph, derivation, work.path.gene, work.fresh, work);
  splice_in_place(derivation, old, work.fresh, whole(work.fresh), work.path.steps);
  return ratio(graph, derivation, locks, Kind::jump, choice, *place, work);
}

std::optional<double> propose_slot(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks,
                                   PlaceChoice choice, std::uint32_t most_genes, RandomStream& random) {
  Workspace& work = workspace();
  const std::optional<Place> place = choose_place(graph, derivation, locks, Kind::slot, choice, work, random);
  if (!place) return std::nullopt;
  const GenePosition parent = work.path.gene;
  const Rule& rule = rule_of(graph, derivation.genes[place->gene]);
  const EdgeId edge = rule.slots[variant_of(graph, derivation.genes[place->gene]).slots[place->slot]].edge;
  SlotState& state = derivation.slots[parent.slot + place->slot];
  const GenePosition child = child_in_slot(graph, derivation, parent, place->slot);
  const SubtreeSlice old =
      state == SlotState::filled ? subtree_at(graph, derivation, child) : SubtreeSlice{child, 0, 0, 0};
  const std::size_t rest = derivation.size() - old.genes;
  const bool fill = graph.edges[edge].required ||
                    random.chance(fill_probability(graph.edges[edge], work.path.above.counts()));
  work.fresh.genes.clear(), work.fresh.slots.clear(), work.fresh.draws.clear();
  work.path.steps.push_back({parent, place->slot});
  if (fill) {
    work.ledger.reset(graph, derivation);
    if (old.genes > 0) work.ledger.remove(graph, derivation, old);
    work.path.above.enter(rule);
    const auto room = static_cast<std::uint32_t>(most_genes > rest ? most_genes - rest : 0);
    if (!draw_subtree(graph, edge, work.path.above.counts(), room, work, random)) return std::nullopt;
    if (old.genes > 0) reuse_draws(graph, derivation, child, work.fresh, work);
  }
  state = fill ? SlotState::filled : SlotState::empty;
  splice_in_place(derivation, old, work.fresh, fill ? whole(work.fresh) : SubtreeSlice{}, work.path.steps);
  return ratio(graph, derivation, locks, Kind::slot, choice, *place, work);
}

}  // namespace espalier
