#include "derivation/adapt.h"

#include <algorithm>

#include "derivation/chances.h"
#include "derivation/sample.h"
#include "derivation/sweep.h"
#include "derivation/writer.h"

namespace espalier {
namespace {

class Adapter {
 public:
  Adapter(const GeneratorGraph& graph, const Derivation& from) : graph_(graph), from_(from) { keeps_.resize(from.size()); }

  /// Marks genes that cannot stay, children before parents: what needs such a child cannot stay either.
  bool find_keepers() {
    sweep_.begin(graph_, from_);
    std::vector<Place> places;
    while (sweep_.next()) {
      const bool possible = variant_probability(sweep_.variant(), sweep_.above()) > 0;
      Place place{possible, false, sweep_.parent()};
      if (sweep_.parent() != GeneSweep::kNoParent) {
        const EdgeId edge = sweep_.gene().edge;
        const bool stands = may_stand(graph_, edge, sweep_.above());
        place.needed = stands && graph_.edges[edge].required;  // an absent slot needs no child
        place.possible &= stands && places[sweep_.parent()].fills[sweep_.parent_slot()];
      }
      for (std::size_t k = 0; k < sweep_.variant().slots.size(); ++k)
        place.fills.push_back(fill_probability(graph_.edges[sweep_.slot_of_rule(k).edge], sweep_.above()) > 0);
      places.push_back(std::move(place));
    }
    for (std::size_t gene = places.size(); gene-- > 0;) {
      keeps_[gene] = places[gene].possible;
      if (places[gene].possible || !places[gene].needed) continue;
      places[places[gene].parent].possible = false;
    }
    return keeps_[0];
  }

  Adapted write() {
    Adapted out;
    out.derivation.detail_seed = from_.detail_seed;
    writer_.begin(out.derivation);
    above_.reset(graph_);
    gene({}, out);
    return out;
  }

 private:
  struct Place {
    bool possible, needed;
    std::uint32_t parent;
    std::vector<bool> fills{};  // by slot: its child has a probability
  };
  struct Frame {
    GenePosition at;
    const Variant* variant;
    const Rule* rule;
    GenePosition child;
    std::uint32_t slot = 0;
  };

  void open(const GenePosition& at, Adapted& out) {
    const GeneRecord& record = from_.genes[at.gene];
    const Rule& rule = graph_.rule_of(record.edge);
    const Variant& variant = rule.variants[record.variant];
    writer_.open(record.edge, record.variant);
    above_.enter(rule);
    GenePosition child = first_child(graph_, from_, at);
    for (std::uint32_t k = 0; k < variant.slots.size(); ++k)
      out.derivation.slots.push_back(state_of(at, k, rule, variant, child, out));
    for (std::size_t d = 0; d < variant.draws.size(); ++d)
      out.derivation.draws.push_back(from_.draws[at.draw + d]);
    writer_.opened();
    stack_.push_back({at, &variant, &rule, first_child(graph_, from_, at)});
  }

  SlotState state_of(const GenePosition& at, std::uint32_t k, const Rule& rule, const Variant& variant,
                     GenePosition& child, Adapted& out) const {
    const EdgeId edge = rule.slots[variant.slots[k]].edge;
    const SlotState state = from_.slots[at.slot + k];
    bool kept = false;
    if (state == SlotState::filled) {
      const SubtreeSlice below = subtree_at(graph_, from_, child);
      kept = keeps_[child.gene];
      if (!kept) out.cut += below.genes;
      child = end_of(below);
    }
    if (!may_stand(graph_, edge, above_.counts())) return SlotState::absent;
    if (kept || state == SlotState::empty || state == SlotState::open) return kept ? SlotState::filled : state;
    return graph_.edges[edge].required ? SlotState::open : SlotState::empty;
  }

  void gene(const GenePosition& root, Adapted& out) {
    open(root, out);
    while (!stack_.empty()) {
      Frame& top = stack_.back();
      if (top.slot == top.variant->slots.size()) {
        writer_.close();
        above_.leave(*top.rule);
        stack_.pop_back();
        continue;
      }
      if (from_.slots[top.at.slot + top.slot++] != SlotState::filled) continue;
      const GenePosition child = top.child;
      top.child = end_of(subtree_at(graph_, from_, child));
      if (keeps_[child.gene]) open(child, out);
    }
  }

  const GeneratorGraph& graph_;
  const Derivation& from_;
  GeneSweep sweep_;
  DepthCounter above_;
  TreeWriter writer_;
  std::vector<Frame> stack_;
  std::vector<char> keeps_;  // by gene of `from`
};

}  // namespace

std::optional<Adapted> adapt(const GeneratorGraph& graph, const Derivation& derivation) {
  Adapter adapter(graph, derivation);
  if (!adapter.find_keepers()) return std::nullopt;
  Adapted out = adapter.write();
  const auto open = [](const Derivation& d) { return std::count(d.slots.begin(), d.slots.end(), SlotState::open); };
  if (open(derivation) > 0 || open(out.derivation) == 0) return out;
  const std::size_t before = out.derivation.size();
  RandomStream random({derivation.detail_seed, Purpose::sample});
  if (!close_open_slots(graph, out.derivation, random)) return std::nullopt;
  out.grown = static_cast<std::uint32_t>(out.derivation.size() - before);
  return out;
}

}  // namespace espalier
