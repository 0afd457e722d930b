#include "derivation/limits.h"

#include <algorithm>
#include <limits>

namespace espalier {

void LimitLedger::reset(const GeneratorGraph& graph) {
  left_.clear();
  const auto limited = [](const Rule& rule) { return rule.limit.has_value(); };
  if (std::none_of(graph.rules.begin(), graph.rules.end(), limited)) return;
  constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max() / 2;
  for (const Rule& rule : graph.rules) left_.push_back(rule.limit ? std::int64_t{*rule.limit} : kUnlimited);
}

void LimitLedger::reset(const GeneratorGraph& graph, const Derivation& derivation) {
  reset(graph);
  if (!active()) return;
  for (const GeneRecord& gene : derivation.genes) --left_[graph.edges[gene.edge].child];
}

void LimitLedger::add(const GeneratorGraph& graph, const Derivation& derivation, const SubtreeSlice& slice) {
  if (!active()) return;
  for (std::uint32_t g = 0; g < slice.genes; ++g) {
    --left_[graph.edges[derivation.genes[slice.begin.gene + g].edge].child];
  }
}

void LimitLedger::remove(const GeneratorGraph& graph, const Derivation& derivation, const SubtreeSlice& slice) {
  if (!active()) return;
  for (std::uint32_t g = 0; g < slice.genes; ++g) {
    ++left_[graph.edges[derivation.genes[slice.begin.gene + g].edge].child];
  }
}

bool LimitLedger::holds() const {
  return std::all_of(left_.begin(), left_.end(), [](std::int64_t left) { return left >= 0; });
}

}  // namespace espalier
