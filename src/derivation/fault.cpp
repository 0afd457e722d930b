#include <fmt/format.h>

#include "derivation/chances.h"
#include "derivation/encode.h"
#include "derivation/limits.h"

namespace espalier {
namespace {

/// Reads a derivation gene by gene, trusting nothing.
class FaultFinder {
 public:
  FaultFinder(const GeneratorGraph& graph, const Derivation& derivation, bool guarded)
      : graph_(graph), derivation_(derivation), guarded_(guarded) {}

  std::string run();

 private:
  struct Frame {
    std::uint32_t gene;
    std::size_t slots, slot;            // of its own; next to look at
    std::size_t slots_end, draws_end;  // behind its own
    const Rule* rule;
    const Variant* variant;
  };

  std::string visit(std::uint32_t gene);
  std::string expect_edge(std::uint32_t gene, EdgeId& edge);
  std::string close_top(std::uint32_t next_gene);
  std::string check_slots(const Frame& frame) const;
  std::string check_slot(const Slot& slot, SlotState state) const;
  std::string place(const Frame& frame) const { return fmt::format("gene {} ({})", frame.gene, frame.rule->name); }

  const GeneratorGraph& graph_;
  const Derivation& derivation_;
  bool guarded_;  // guards and probabilities count
  std::vector<Frame> stack_;
  DepthCounter above_, below_;
  LimitLedger ledger_;
  std::size_t slots_ = 0, draws_ = 0;  // read so far
};

std::string FaultFinder::close_top(std::uint32_t next_gene) {
  const Frame& top = stack_.back();
  const GeneRecord& record = derivation_.genes[top.gene];
  const auto wrong = [&](const char* what, std::size_t stored, std::size_t counted) {
    return fmt::format("{}: {} is {}, but {} are below it", place(top), what, stored, counted);
  };
  const std::size_t genes = next_gene - top.gene - 1;
  if (record.genes_below != genes) return wrong("genes_below", record.genes_below, genes);
  const std::size_t slots = slots_ - top.slots_end, draws = draws_ - top.draws_end;
  if (record.slots_below != slots) return wrong("slots_below", record.slots_below, slots);
  if (record.draws_below != draws) return wrong("draws_below", record.draws_below, draws);
  below_.leave(*top.rule);
  stack_.pop_back();
  if (!stack_.empty()) above_.leave(*stack_.back().rule);
  return {};
}

std::string FaultFinder::expect_edge(std::uint32_t gene, EdgeId& edge) {
  edge = 0;
  if (gene == 0) return {};
  while (!stack_.empty()) {
    Frame& top = stack_.back();
    while (top.slot < top.variant->slots.size()) {
      const std::size_t k = top.slot++;
      if (derivation_.slots[top.slots + k] != SlotState::filled) continue;
      edge = top.rule->slots[top.variant->slots[k]].edge;
      above_.enter(*top.rule);
      return {};
    }
    if (std::string fault = close_top(gene); !fault.empty()) return fault;
  }
  return fmt::format("gene {}: no filled slot is left for it", gene);
}

std::string FaultFinder::check_slot(const Slot& slot, SlotState state) const {
  if (state > SlotState::absent) return fmt::format("has the unknown state {}", static_cast<int>(state));
  if (!guarded_) return {};
  const Edge& edge = graph_.edges[slot.edge];
  const bool guard = may_stand(graph_, slot.edge, below_.counts());
  const std::uint32_t depth = below_.counts().depth;
  if (state == SlotState::absent && guard) return fmt::format("is absent, but its guard holds at depth {}", depth);
  if (state != SlotState::absent && !guard) return fmt::format("is not absent, but its guard fails at depth {}", depth);
  if (state == SlotState::empty && edge.required) return "is required, but empty";
  if (state == SlotState::filled && fill_probability(edge, above_.counts()) <= 0) {
    return fmt::format("is filled, but has probability 0 at depth {}", above_.counts().depth);
  }
  return {};
}

std::string FaultFinder::check_slots(const Frame& frame) const {
  for (std::size_t k = 0; k < frame.variant->slots.size(); ++k) {
    const Slot& slot = frame.rule->slots[frame.variant->slots[k]];
    const std::string fault = check_slot(slot, derivation_.slots[frame.slots + k]);
    if (!fault.empty()) return fmt::format("{}: slot {} {}", place(frame), slot.name, fault);
  }
  return {};
}

std::string FaultFinder::visit(std::uint32_t gene) {
  EdgeId edge;
  if (std::string fault = expect_edge(gene, edge); !fault.empty()) return fault;
  const GeneRecord& record = derivation_.genes[gene];
  const Rule& rule = graph_.rule_of(edge);
  if (record.edge != edge) {
    return fmt::format("gene {}: edge {} stands in a slot of edge {} ({})", gene, record.edge, edge, rule.name);
  }
  if (record.variant >= rule.variants.size()) {
    return fmt::format("gene {} ({}): variant {} of {}", gene, rule.name, record.variant, rule.variants.size());
  }
  const Variant& variant = rule.variants[record.variant];
  const Frame frame{gene, slots_, 0, slots_ + variant.slots.size(), draws_ + variant.draws.size(), &rule, &variant};
  if (frame.slots_end > derivation_.slots.size()) return fmt::format("{}: its slots are missing", place(frame));
  if (frame.draws_end > derivation_.draws.size()) return fmt::format("{}: its draws are missing", place(frame));
  if (guarded_ && variant_probability(variant, above_.counts()) <= 0) {
    return fmt::format("{}: variant {} has probability 0 at depth {}", place(frame), record.variant,
                       above_.counts().depth);
  }
  if (!ledger_.add(graph_.edges[edge].child)) {
    return fmt::format("{}: one more than `limit {}`", place(frame), rule.limit.value_or(0));
  }
  slots_ = frame.slots_end;
  draws_ = frame.draws_end;
  below_.enter(rule);
  stack_.push_back(frame);
  return check_slots(frame);
}

std::string FaultFinder::run() {
  if (derivation_.genes.empty()) return "it has no genes";
  above_.reset(graph_);
  below_.reset(graph_);
  ledger_.reset(graph_);
  const std::uint32_t genes = static_cast<std::uint32_t>(derivation_.size());
  for (std::uint32_t gene = 0; gene < genes; ++gene) {
    if (std::string fault = visit(gene); !fault.empty()) return fault;
  }
  while (!stack_.empty()) {
    const Frame& top = stack_.back();
    for (std::size_t k = top.slot; k < top.variant->slots.size(); ++k) {
      if (derivation_.slots[top.slots + k] != SlotState::filled) continue;
      return fmt::format("{}: slot {} is filled, but its gene is missing", place(top),
                         top.rule->slots[top.variant->slots[k]].name);
    }
    if (std::string fault = close_top(genes); !fault.empty()) return fault;
  }
  if (slots_ != derivation_.slots.size()) return fmt::format("{} slots too many", derivation_.slots.size() - slots_);
  if (draws_ != derivation_.draws.size()) return fmt::format("{} draws too many", derivation_.draws.size() - draws_);
  return {};
}

}  // namespace

std::string find_fault(const GeneratorGraph& graph, const Derivation& derivation, Fit fit) {
  return FaultFinder(graph, derivation, fit != Fit::adaptable).run();
}

}  // namespace espalier
