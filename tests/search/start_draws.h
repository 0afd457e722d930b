#pragma once
// A grammar made by hand whose genome is the draws of its start rule: one of 8 values, one of 5, two continuous, one
// circular.

#include <cmath>

#include "search/test_graph.h"

namespace espalier::testing {

inline std::shared_ptr<const GeneratorGraph> start_draws_graph() {
  auto graph = std::make_shared<GeneratorGraph>();
  graph->name = "draws";
  graph->source_hash = "draws";
  Rule rule = make_rule("Tree", 5, {});
  rule.draws[0].shape = rule.draws[1].shape = DrawShape::discrete;
  rule.draws[0].values = 8, rule.draws[1].values = 5;
  rule.draws[4].shape = DrawShape::circular;
  graph->rules = {rule};
  graph->edges = {make_edge(0, 0, true, 1, "Tree")};
  return graph;
}

/// Higher, up to 0, the nearer draws 0 to 3 are to 0.7. What has draw 2 below `least` is not acceptable.
class NearScorer final : public BatchScorer {
 public:
  explicit NearScorer(double least = 0) : least_(least) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      scores[i] = 0;
      for (std::size_t k = 0; k < 4; ++k) scores[i] -= std::abs(derivations[i]->draws[k] * 0x1p-32 - 0.7);
      if (derivations[i]->draws[2] * 0x1p-32 < least_) scores[i] = kNotAcceptable;
      ++asked;
    }
  }
  double optimum() const override { return 0; }
  std::string describe_rejections() const override { return "too low"; }

  std::uint64_t asked = 0;

 private:
  double least_;
};

}  // namespace espalier::testing
