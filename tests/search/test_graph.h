#pragma once
// A small grammar made by hand, so that the search is tested without the language: a Root with two places for a Twig; a
// Twig has a draw, two places for a Twig and one for a Bud; a Bud has a draw.

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "derivation/derivation.h"
#include "score/objective.h"

namespace espalier::testing {

inline constexpr EdgeId kRootEdge = 0, kRootTwig = 1, kTwigTwig = 2, kTwigBud = 3;

inline Rule make_rule(const std::string& name, int draws, const std::vector<Slot>& slots) {
  Rule rule;
  rule.name = name;
  rule.slots = slots;
  Variant variant;
  for (int i = 0; i < draws; ++i) {
    rule.draws.push_back({name + ".d" + std::to_string(i), DrawShape::continuous, 0});
    variant.draws.push_back(static_cast<std::uint16_t>(i));
  }
  for (std::size_t i = 0; i < slots.size(); ++i) variant.slots.push_back(static_cast<std::uint16_t>(i));
  rule.variants.push_back(variant);
  return rule;
}

inline Edge make_edge(RuleId parent, RuleId child, bool required, double p, const std::string& name) {
  Edge edge;
  edge.parent = parent;
  edge.child = child;
  edge.required = required;
  edge.probability = DepthValue(p);
  edge.name = name;
  return edge;
}

inline std::shared_ptr<const GeneratorGraph> twig_graph() {
  auto graph = std::make_shared<GeneratorGraph>();
  graph->name = "twigs";
  graph->source_hash = "twigs";
  graph->rules = {make_rule("Root", 0, {{"Twig[0]", kRootTwig}, {"Twig[1]", kRootTwig}}),
                  make_rule("Twig", 1, {{"Twig[0]", kTwigTwig}, {"Twig[1]", kTwigTwig}, {"Bud", kTwigBud}}),
                  make_rule("Bud", 1, {})};
  graph->edges = {make_edge(0, 0, true, 1, "Root"), make_edge(0, 1, false, 0.5, "Root/Twig"),
                  make_edge(1, 1, false, 0.4, "Twig/Twig"), make_edge(1, 2, false, 0.3, "Twig/Bud")};
  return graph;
}

/// A Root with one required Twig that has no slots: nothing to grow, two genes for ever.
inline std::shared_ptr<const GeneratorGraph> stunted_graph() {
  auto graph = std::make_shared<GeneratorGraph>();
  graph->name = "stunted";
  graph->source_hash = "stunted";
  graph->rules = {make_rule("Root", 0, {{"Twig", kRootTwig}}), make_rule("Twig", 1, {})};
  graph->edges = {make_edge(0, 0, true, 1, "Root"), make_edge(0, 1, true, 1, "Root/Twig")};
  return graph;
}

inline std::size_t buds_in(const Derivation& derivation) {
  return static_cast<std::size_t>(std::count_if(derivation.genes.begin(), derivation.genes.end(),
                                                [](const GeneRecord& gene) { return gene.edge == kTwigBud; }));
}

/// Score: the number of Buds, plus a bonus below 1 for small draws. Remembers what it was asked.
class BudScorer final : public BatchScorer {
 public:
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    ++batches;
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      scores[i] = score_of(*derivations[i]);
      asked.push_back(hash(*derivations[i]));
    }
  }
  double optimum() const override { return 100; }

  static double score_of(const Derivation& derivation) {
    double buds = 0, sum = 0;
    for (const GeneRecord& gene : derivation.genes) buds += gene.edge == kTwigBud;
    for (const std::uint32_t draw : derivation.draws) sum += draw * 0x1p-32;
    return buds - (derivation.draws.empty() ? 0 : 0.5 * sum / static_cast<double>(derivation.draws.size()));
  }

  int batches = 0;
  std::vector<std::uint64_t> asked;
};

/// The same, but what `accepts` says no to is not acceptable. Counts those.
class ChoosyScorer final : public BatchScorer {
 public:
  using Rule = std::function<bool(const Derivation&)>;
  explicit ChoosyScorer(Rule rule) : accepts(std::move(rule)) {}

  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      const bool good = accepts(*derivations[i]);
      scores[i] = good ? BudScorer::score_of(*derivations[i]) : -std::numeric_limits<double>::infinity();
      ++asked;
      rejected += !good;
    }
  }
  double optimum() const override { return 100; }
  std::string describe_rejections() const override { return "it is choosy"; }

  Rule accepts;
  std::uint64_t asked = 0, rejected = 0;
};

}  // namespace espalier::testing
