#include "derivation/sample.h"

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/chances.h"
#include "derivation/growth.h"

namespace espalier {
namespace {

/// Genes in the order in which they were made, each with its slots; packed into depth-first order at the end.
class BreadthFirst {
 public:
  BreadthFirst(const GeneratorGraph& graph, RandomStream& random) : graph_(graph), random_(random) {}

  /// One draw from the prior. False if a limit was broken; `broken` is then its rule.
  bool run(std::uint32_t most_genes, RuleId& broken);
  Derivation pack() const;

 private:
  struct Gene {
    EdgeId edge;
    std::uint16_t variant;
    std::size_t slots, draws;  // where its own begin
  };

  bool make(EdgeId edge, const DepthCounter& above);

  const GeneratorGraph& graph_;
  RandomStream& random_;
  LimitLedger ledger_;
  std::vector<Gene> genes_;
  std::vector<DepthCounter> below_;     // per gene: counts for its children
  std::vector<SlotState> slots_;
  std::vector<std::uint32_t> children_;  // per slot: its gene
  std::vector<std::uint32_t> draws_;
};

bool BreadthFirst::make(EdgeId edge, const DepthCounter& above) {
  const Rule& rule = graph_.rule_of(edge);
  if (!ledger_.add(graph_.edges[edge].child)) return false;
  const std::optional<std::uint16_t> picked = pick_variant(rule, above.counts(), random_);
  if (!picked) {
    throw Error(fmt::format("grammar {}: rule {}: every alternative of a choice weighs 0 at depth {}", graph_.name,
                            rule.name, above.counts().depth));
  }
  genes_.push_back({edge, *picked, slots_.size(), draws_.size()});
  DepthCounter below = above;
  below.enter(rule);
  append_open_slots(graph_, rule, rule.variants[*picked], below.counts(), slots_);
  append_draws(rule.variants[*picked], random_, draws_);
  children_.resize(slots_.size());
  below_.push_back(std::move(below));
  return true;
}

bool BreadthFirst::run(std::uint32_t most_genes, RuleId& broken) {
  genes_.clear(), below_.clear(), slots_.clear(), children_.clear(), draws_.clear();
  ledger_.reset(graph_);
  DepthCounter above;
  above.reset(graph_);
  broken = graph_.start();
  if (!make(0, above)) return false;
  for (std::size_t g = 0; g < genes_.size() && genes_.size() < most_genes; ++g) {
    const Gene gene = genes_[g];
    const Rule& rule = graph_.rule_of(gene.edge);
    above = below_[g];
    above.leave(rule);
    const Variant& variant = rule.variants[gene.variant];
    for (std::size_t k = 0; k < variant.slots.size() && genes_.size() < most_genes; ++k) {
      const std::size_t slot = gene.slots + k;
      if (slots_[slot] == SlotState::absent) continue;
      const EdgeId edge = rule.slots[variant.slots[k]].edge;
      const Edge& way = graph_.edges[edge];
      const bool fill = way.required || random_.chance(fill_probability(way, above.counts()));
      slots_[slot] = fill ? SlotState::filled : SlotState::empty;
      if (!fill) continue;
      children_[slot] = static_cast<std::uint32_t>(genes_.size());
      broken = way.child;
      const DepthCounter below = below_[g];
      if (!make(edge, below)) return false;
    }
  }
  return true;
}

Derivation BreadthFirst::pack() const {
  struct Frame {
    std::uint32_t gene;
    std::size_t slot, end;
  };
  Derivation packed;
  TreeWriter writer;
  writer.begin(packed);
  std::vector<Frame> stack;
  const auto push = [&](std::uint32_t g) {
    const Gene& gene = genes_[g];
    const Variant& variant = graph_.rule_of(gene.edge).variants[gene.variant];
    writer.open(gene.edge, gene.variant);
    const std::size_t end = gene.slots + variant.slots.size();
    for (std::size_t s = gene.slots; s < end; ++s) packed.slots.push_back(slots_[s]);
    for (std::size_t k = 0; k < variant.draws.size(); ++k) packed.draws.push_back(draws_[gene.draws + k]);
    writer.opened();
    stack.push_back({g, gene.slots, end});
  };
  push(0);
  while (!stack.empty()) {
    Frame& top = stack.back();
    if (top.slot == top.end) {
      writer.close();
      stack.pop_back();
      continue;
    }
    const std::size_t slot = top.slot++;
    if (slots_[slot] == SlotState::filled) push(children_[slot]);
  }
  return packed;
}

bool any_open(const Derivation& derivation) {
  for (const SlotState state : derivation.slots) {
    if (state == SlotState::open) return true;
  }
  return false;
}

}  // namespace

Derivation seedling(const GeneratorGraph& graph, RandomStream& random) {
  return sample(graph, random, 1).derivation;
}

SampleResult sample(const GeneratorGraph& graph, RandomStream& random, std::uint32_t most_genes) {
  CHECK(most_genes >= 1);
  const std::uint64_t detail_seed = random.next_u64();
  constexpr int kMostTries = 1000;
  BreadthFirst growth(graph, random);
  RuleId broken = 0;
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    if (!growth.run(most_genes, broken)) continue;
    SampleResult result{growth.pack(), false};
    result.derivation.detail_seed = detail_seed;
    result.truncated = any_open(result.derivation);
    return result;
  }
  const Rule& rule = graph.rules[broken];
  throw Error(fmt::format("grammar {}: rule {}: {} samples in a row broke `limit {}`", graph.name, rule.name,
                          kMostTries, rule.limit.value_or(0)));
}

}  // namespace espalier
