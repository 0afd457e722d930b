#include "derivation/growth.h"

#include "derivation/chances.h"

namespace espalier {

void append_open_slots(const GeneratorGraph& graph, const Rule& rule, const Variant& variant, const DepthCounts& below,
                       std::vector<SlotState>& slots) {
  for (const std::uint16_t s : variant.slots) {
    slots.push_back(may_stand(graph, rule.slots[s].edge, below) ? SlotState::open : SlotState::absent);
  }
}

void append_draws(const Variant& variant, RandomStream& random, std::vector<std::uint32_t>& draws) {
  for (std::size_t k = 0; k < variant.draws.size(); ++k) draws.push_back(random.next_u32());
}

GrowthFault Growth::push(const GeneratorGraph& graph, EdgeId edge, RandomStream& random, LimitLedger& ledger,
                         Derivation& out) {
  const Rule& rule = graph.rule_of(edge);
  if (!ledger.add(graph.edges[edge].child)) return GrowthFault::limit;
  const std::optional<std::uint16_t> picked = pick_variant(rule, above_.counts(), random);
  if (!picked) return GrowthFault::no_variant;
  const Variant& variant = rule.variants[*picked];
  writer_.open(edge, *picked);
  stack_.push_back({out.slots.size(), 0, &rule, &variant});
  above_.enter(rule);
  append_open_slots(graph, rule, variant, above_.counts(), out.slots);
  append_draws(variant, random, out.draws);
  writer_.opened();
  return GrowthFault::none;
}

/// What the grammar computes it from are the genes above the parent, which is the top of the stack.
double Growth::fill_probability_at(const Frame& frame, const Edge& edge) {
  above_.leave(*frame.rule);
  const double p = fill_probability(edge, above_.counts());
  above_.enter(*frame.rule);
  return p;
}

GrowthFault Growth::append(const GeneratorGraph& graph, EdgeId edge, const DepthCounts& above, RandomStream& random,
                           LimitLedger& ledger, Derivation& out, std::uint32_t most_genes,
                           OptionalSlots optional) {
  stack_.clear();
  above_.reset(above);
  writer_.begin(out);
  const std::size_t first = out.genes.size();
  GrowthFault fault = push(graph, edge, random, ledger, out);
  while (fault == GrowthFault::none && !stack_.empty()) {
    Frame& top = stack_.back();
    if (top.slot == top.variant->slots.size()) {
      above_.leave(*top.rule);
      writer_.close();
      stack_.pop_back();
      continue;
    }
    const EdgeId child = top.rule->slots[top.variant->slots[top.slot]].edge;
    SlotState& state = out.slots[top.slots + top.slot++];
    if (state == SlotState::absent) continue;
    const Edge& way = graph.edges[child];
    const bool fill = way.required ||
                      (optional == OptionalSlots::by_prior && random.chance(fill_probability_at(top, way)));
    state = fill ? SlotState::filled : SlotState::empty;
    if (state == SlotState::empty) continue;
    if (out.genes.size() - first >= most_genes) return GrowthFault::too_big;
    fault = push(graph, child, random, ledger, out);
  }
  return fault;
}

}  // namespace espalier
