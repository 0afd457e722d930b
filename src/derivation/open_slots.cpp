#include <algorithm>

#include "derivation/chances.h"
#include "derivation/growth.h"
#include "derivation/sample.h"
#include "derivation/splice.h"
#include "derivation/sweep.h"

namespace espalier {
namespace {

struct OpenSlot {
  std::uint32_t gene = 0;
  std::uint32_t slot = 0;  // index into the variant's slots
};

/// Appends the single gene that stands in a slot of `edge`: variant and draws from the prior, slots open. False where
/// no variant can be.
bool append_seedling(const GeneratorGraph& graph, EdgeId edge, DepthCounter above, RandomStream& random,
                     Derivation& out) {
  const Rule& rule = graph.rule_of(edge);
  const std::optional<std::uint16_t> picked = pick_variant(rule, above.counts(), random);
  if (!picked) return false;
  TreeWriter writer;
  writer.begin(out);
  writer.open(edge, *picked);
  above.enter(rule);
  append_open_slots(graph, rule, rule.variants[*picked], above.counts(), out.slots);
  append_draws(rule.variants[*picked], random, out.draws);
  writer.opened();
  writer.close();
  return true;
}

/// Open slots that can be decided, in order; with those of full rules where growth is strict.
void find_open_slots(const GeneratorGraph& graph, const Derivation& derivation, const LimitLedger& ledger, bool strict,
                     std::vector<OpenSlot>& found) {
  found.clear();
  std::size_t first = 0;  // of the gene's own slots
  for (std::uint32_t g = 0; g < derivation.size(); ++g) {
    const Rule& rule = rule_of(graph, derivation.genes[g]);
    const Variant& variant = rule.variants[derivation.genes[g].variant];
    for (std::uint32_t k = 0; k < variant.slots.size(); ++k) {
      if (derivation.slots[first + k] != SlotState::open) continue;
      const Edge& edge = graph.edges[rule.slots[variant.slots[k]].edge];
      if (strict || !edge.required || ledger.has_room(edge.child)) found.push_back({g, k});
    }
    first += variant.slots.size();
  }
}

/// Takes out the slot to decide next. Depth-first growth has decided all slots before that of the gene where it stands,
/// which is the last one with an open slot.
OpenSlot take_slot(std::vector<OpenSlot>& open, SlotOrder order, RandomStream& random) {
  std::size_t i = open.size() - 1;
  if (order == SlotOrder::random) i = random.below(static_cast<std::uint32_t>(open.size()));
  else while (i > 0 && open[i - 1].gene == open.back().gene) --i;
  const OpenSlot taken = open[i];
  open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
  return taken;
}

enum class Decision : std::uint8_t {
  empty,
  filled,
  made,       // filled, with a gene that emits or has a bone
  forbidden,  // the slot is still open
};

/// Decides one open slot by the prior.
Decision decide(const GeneratorGraph& graph, const OpenSlot& open, bool strict, LimitLedger& ledger,
                RandomStream& random, Derivation& derivation) {
  GenePath path;
  locate(graph, derivation, open.gene, path);
  const Rule& rule = rule_of(graph, derivation.genes[open.gene]);
  const EdgeId edge = rule.slots[variant_of(graph, derivation.genes[open.gene]).slots[open.slot]].edge;
  const Edge& way = graph.edges[edge];
  const std::size_t slot = path.gene.slot + open.slot;
  const bool fill = way.required || random.chance(fill_probability(way, path.above.counts()));
  if (!fill) {
    derivation.slots[slot] = SlotState::empty;
    return Decision::empty;
  }
  Derivation gene;
  path.above.enter(rule);
  if (!ledger.has_room(way.child) || !append_seedling(graph, edge, path.above, random, gene)) {
    if (strict || way.required) return Decision::forbidden;
    derivation.slots[slot] = SlotState::empty;
    return Decision::empty;
  }
  ledger.add(way.child);
  const GenePosition place = child_in_slot(graph, derivation, path.gene, open.slot);
  path.steps.push_back({path.gene, open.slot});
  splice_in_place(derivation, {place, 0, 0, 0}, gene, whole(gene), path.steps);
  derivation.slots[slot] = SlotState::filled;
  return makes_something(variant_of(graph, gene.genes[0])) ? Decision::made : Decision::filled;
}

/// Writes a closed copy of a derivation.
class Closer {
 public:
  Closer(const GeneratorGraph& graph, const Derivation& from, RandomStream& random)
      : graph_(graph), from_(from), random_(random) {}

  bool run(LimitLedger ledger, std::uint32_t most_genes, Derivation& out);

 private:
  struct Frame {
    GenePosition gene;     // in from
    GenePosition child;    // in from: the next child
    std::size_t slots;     // in out: the gene's own
    std::size_t slot = 0;  // next to look at
  };

  void push(const GenePosition& gene, Derivation& out);
  const Rule& rule(const Frame& frame) const { return rule_of(graph_, from_.genes[frame.gene.gene]); }

  const GeneratorGraph& graph_;
  const Derivation& from_;
  RandomStream& random_;
  std::vector<Frame> stack_;
  TreeWriter writer_;
  DepthCounter above_;  // of what stands in the slots of the top frame
  Growth growth_;
};

void Closer::push(const GenePosition& gene, Derivation& out) {
  const GeneRecord& record = from_.genes[gene.gene];
  const GenePosition child = first_child(graph_, from_, gene);
  writer_.open(record.edge, record.variant);
  stack_.push_back({gene, child, out.slots.size()});
  out.slots.insert(out.slots.end(), from_.slots.begin() + gene.slot, from_.slots.begin() + child.slot);
  out.draws.insert(out.draws.end(), from_.draws.begin() + gene.draw, from_.draws.begin() + child.draw);
  writer_.opened();
  above_.enter(rule_of(graph_, record));
}

bool Closer::run(LimitLedger ledger, std::uint32_t most_genes, Derivation& out) {
  out.genes.clear(), out.slots.clear(), out.draws.clear();
  stack_.clear();
  writer_.begin(out);
  above_.reset(graph_);
  push({}, out);
  while (!stack_.empty()) {
    Frame& top = stack_.back();
    const Variant& variant = variant_of(graph_, from_.genes[top.gene.gene]);
    if (top.slot == variant.slots.size()) {
      writer_.close();
      above_.leave(rule(top));
      stack_.pop_back();
      continue;
    }
    const EdgeId edge = rule(top).slots[variant.slots[top.slot]].edge;
    SlotState& state = out.slots[top.slots + top.slot++];
    if (state == SlotState::filled) {
      const GenePosition child = top.child;
      top.child = end_of(subtree_at(graph_, from_, child));
      push(child, out);
    } else if (state == SlotState::open) {
      state = graph_.edges[edge].required ? SlotState::filled : SlotState::empty;
      if (state == SlotState::empty) continue;
      if (out.size() >= most_genes) return false;
      const auto room = static_cast<std::uint32_t>(most_genes - out.size());
      const GrowthFault fault = growth_.append(graph_, edge, above_.counts(), random_, ledger, out, room);
      if (fault != GrowthFault::none) return false;
    }
  }
  return true;
}

}  // namespace

bool makes_something(const Variant& variant) {
  return std::any_of(variant.program.ops.begin(), variant.program.ops.end(),
                     [](const Op& op) {
                       return op.code == OpCode::emit || op.code == OpCode::bone || op.code == OpCode::bone_along;
                     });
}

GrowthStep grow_open_slot(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random, SlotOrder order,
                          bool strict) {
  LimitLedger ledger;
  ledger.reset(graph, derivation);
  std::vector<OpenSlot> open;
  bool decided = false;
  constexpr std::size_t kMostNew = 1000;  // grammars need not emit at all
  const std::size_t most_genes = derivation.size() + kMostNew;
  while (derivation.size() < most_genes) {
    find_open_slots(graph, derivation, ledger, strict, open);
    Decision decision = Decision::forbidden;
    while (decision == Decision::forbidden && !open.empty()) {
      decision = decide(graph, take_slot(open, order, random), strict, ledger, random, derivation);
      if (decision == Decision::forbidden && strict) return GrowthStep::stuck;
    }
    if (decision == Decision::forbidden) break;
    decided = true;
    if (decision == Decision::made) break;
  }
  return decided ? GrowthStep::grown : GrowthStep::finished;
}

bool is_finished(const Derivation& derivation) {
  return std::find(derivation.slots.begin(), derivation.slots.end(), SlotState::open) == derivation.slots.end();
}

bool close_open_slots(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random,
                      std::uint32_t most_genes) {
  if (is_finished(derivation)) return true;
  LimitLedger ledger;
  ledger.reset(graph, derivation);
  Closer closer(graph, derivation, random);
  Derivation closed;
  closed.detail_seed = derivation.detail_seed;
  constexpr int kMostTries = 100;
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    if (!closer.run(ledger, most_genes, closed)) continue;
    derivation = std::move(closed);
    return true;
  }
  return false;
}

}  // namespace espalier
