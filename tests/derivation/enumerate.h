#pragma once
// Every derivation of a tiny graph, with its prior probability, by plain recursion over the rules: the reference that
// sampling and log_prior are held against. Draws are left out.

#include <map>
#include <string>
#include <vector>

#include "derivation/derivation.h"

namespace espalier::test {

struct Enumerated {
  std::string key;  // of key_of(derivation)
  double probability = 1;
  std::map<RuleId, std::uint32_t> genes;  // per rule
};

/// Genes as "edge.variant" and slot states as letters, each gene followed by what stands in its slots.
inline std::string key_of(const GeneratorGraph& graph, const Derivation& derivation) {
  std::string key;
  std::size_t slot = 0;
  for (const GeneRecord& gene : derivation.genes) {
    key += std::to_string(gene.edge) + "." + std::to_string(gene.variant);
    for (std::size_t k = 0; k < variant_of(graph, gene).slots.size(); ++k) {
      key += "OEFA"[static_cast<int>(derivation.slots[slot++])];
    }
    key += " ";
  }
  return key;
}

class Enumeration {
 public:
  explicit Enumeration(const GeneratorGraph& graph) : graph_(graph), of_rule_(graph.counted_rules.size()) {
    all_ = genes_of(0);
  }
  const std::vector<Enumerated>& all() const { return all_; }

 private:
  DepthCounts counts() const { return {depth_, of_rule_}; }

  std::vector<Enumerated> genes_of(EdgeId edge) {
    const Rule& rule = graph_.rule_of(edge);
    std::vector<Enumerated> all;
    for (std::size_t v = 0; v < rule.variants.size(); ++v) {
      const double chance = rule.variants[v].probability.at(counts());
      if (chance > 0) expand(edge, v, chance, all);
    }
    return all;
  }

  void expand(EdgeId edge, std::size_t v, double chance, std::vector<Enumerated>& all) {
    const RuleId id = graph_.edges[edge].child;
    const Rule& rule = graph_.rules[id];
    // Alternatives so far: the gene's own letters, what stands below, probability, counts.
    struct Partial {
      std::string letters, below;
      double probability;
      std::map<RuleId, std::uint32_t> genes;
    };
    std::vector<Partial> partials = {{"", "", chance, {{id, 1}}}};
    for (const std::uint16_t s : rule.variants[v].slots) {
      const Edge& way = graph_.edges[rule.slots[s].edge];
      const double p = way.required ? 1 : way.probability.at(counts());
      ++depth_;
      if (rule.counted) ++of_rule_[*rule.counted];
      const Rule& child = graph_.rules[way.child];
      const bool stands = !child.guarded || child.guard.at(counts()) != 0;
      std::vector<Enumerated> children;
      if (stands && p > 0) children = genes_of(rule.slots[s].edge);
      --depth_;
      if (rule.counted) --of_rule_[*rule.counted];
      std::vector<Partial> next;
      for (const Partial& partial : partials) {
        if (!stands) {
          next.push_back({partial.letters + "A", partial.below, partial.probability, partial.genes});
          continue;
        }
        if (p < 1) next.push_back({partial.letters + "E", partial.below, partial.probability * (1 - p), partial.genes});
        for (const Enumerated& one : children) {
          Partial with{partial.letters + "F", partial.below + one.key, partial.probability * p * one.probability,
                       partial.genes};
          for (const auto& [rule_id, n] : one.genes) with.genes[rule_id] += n;
          next.push_back(std::move(with));
        }
      }
      partials = std::move(next);
    }
    const std::string self = std::to_string(edge) + "." + std::to_string(v);
    for (const Partial& partial : partials) {
      all.push_back({self + partial.letters + " " + partial.below, partial.probability, partial.genes});
    }
  }

  const GeneratorGraph& graph_;
  std::uint32_t depth_ = 0;
  std::vector<std::uint32_t> of_rule_;
  std::vector<Enumerated> all_;
};

}  // namespace espalier::test
