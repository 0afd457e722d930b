#include "derivation/sweep.h"

#include "base/check.h"

namespace espalier {

void GeneSweep::begin(const GeneratorGraph& graph, const Derivation& derivation) {
  begin(graph, derivation, GenePosition{}, DepthCounts{});
  above_.reset(graph);
  below_.reset(graph);
}

void GeneSweep::begin(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& top,
                      const DepthCounts& above) {
  graph_ = &graph;
  derivation_ = &derivation;
  stack_.clear();
  above_.reset(above);
  below_.reset(above);
  next_ = top;
  end_ = derivation.genes.empty() ? 0 : top.gene + 1 + derivation.genes[top.gene].genes_below;
  parent_ = kNoParent;
  parent_slot_ = 0;
}

bool GeneSweep::next() {
  if (next_.gene == end_) return false;
  while (!stack_.empty() && next_.gene == stack_.back().end) {
    below_.leave(*stack_.back().rule);
    stack_.pop_back();
    if (!stack_.empty()) above_.leave(*stack_.back().rule);
  }
  if (!stack_.empty()) {
    Frame& top = stack_.back();
    while (derivation_->slots[top.gene.slot + top.slot] != SlotState::filled) ++top.slot;
    parent_ = top.gene.gene;
    parent_slot_ = top.slot++;
    above_.enter(*top.rule);
  }
  push(next_);
  return true;
}

void GeneSweep::push(const GenePosition& gene) {
  const GeneRecord& record = derivation_->genes[gene.gene];
  const Rule& rule = rule_of(*graph_, record);
  const Variant& variant = rule.variants[record.variant];
  stack_.push_back({gene, gene.gene + 1 + record.genes_below, 0, &rule, &variant});
  below_.enter(rule);
  next_ = {gene.gene + 1, gene.slot + static_cast<std::uint32_t>(variant.slots.size()),
           gene.draw + static_cast<std::uint32_t>(variant.draws.size())};
}

}  // namespace espalier
