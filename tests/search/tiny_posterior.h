#pragma once
// A grammar so small that its posterior can be written down: prior * exp(beta * score) of every derivation. Samplers
// are held against it.

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "derivation/enumerate.h"
#include "derivation/test_graph.h"
#include "score/objective.h"

namespace espalier::testing {

/// The same graph, where every gene has a bone: growth goes gene by gene.
inline std::shared_ptr<const GeneratorGraph> with_bones(GeneratorGraph graph) {
  Op bone;
  bone.code = OpCode::bone;
  for (Rule& rule : graph.rules) {
    for (Variant& variant : rule.variants) variant.program.ops.push_back(bone);
  }
  return std::make_shared<GeneratorGraph>(std::move(graph));
}

/// Root with two places for a Twig and one for a Bud; a Twig, at most two levels of them, comes plain or forked, and
/// has a draw; plain ones have a place for a Bud, forked ones two for Twigs too. `most_buds` is a limit of the grammar,
/// 0: none. Everything has a bone.
inline std::shared_ptr<const GeneratorGraph> tiny_graph(std::uint32_t most_buds = 0) {
  test::GraphBuilder b("tiny");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig", 1), bud = b.rule("Bud");
  b.guard(twig, test::depth_below(3));
  b.maybe(root, twig, 0.6, 2);
  b.maybe(root, bud, 0.3);
  b.maybe(twig, bud, 0.4);
  b.maybe(twig, twig, 0.35, 2);
  b.variant(twig, 0.7, {0}, {0});
  b.variant(twig, 0.3, {0}, {0, 1, 2});
  if (most_buds > 0) b.limit(bud, most_buds);
  return with_bones(b.build());
}

/// Buds are good, forks cost, many genes cost more and more; every draw gives its quantile, in 0..1, besides.
inline double tiny_score(std::size_t genes, std::size_t buds, std::size_t forks) {
  const auto n = static_cast<double>(genes);
  return 0.9 * static_cast<double>(buds) - 0.5 * static_cast<double>(forks) - 0.05 * n * n;
}

inline double tiny_score(const GeneratorGraph& graph, const Derivation& derivation) {
  std::size_t buds = 0, forks = 0;
  for (const GeneRecord& gene : derivation.genes) {
    buds += graph.edges[gene.edge].child == 2;
    forks += graph.edges[gene.edge].child == 1 && gene.variant == 1;
  }
  double draws = 0;
  for (const std::uint32_t draw : derivation.draws) draws += draw * 0x1p-32;
  return tiny_score(derivation.size(), buds, forks) + draws;
}

class TinyScorer final : public BatchScorer {
 public:
  explicit TinyScorer(std::shared_ptr<const GeneratorGraph> graph) : graph_(std::move(graph)) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) scores[i] = tiny_score(*graph_, *derivations[i]);
  }
  double optimum() const override { return 10; }

 private:
  std::shared_ptr<const GeneratorGraph> graph_;
};

/// What the weight of a derivation of the tiny graph depends on, beside its draws, of which each Twig has one.
struct TinyCounts {
  std::size_t genes = 0, twigs = 0, buds = 0, forks = 0;
};

/// prior * weight(TinyCounts) by key_of(derivation), not normalised; limits of the grammar and on genes hold.
template <typename Weight>
std::map<std::string, double> tiny_density(const GeneratorGraph& graph, std::size_t most_genes, Weight weight) {
  std::map<std::string, double> density;
  const test::Enumeration enumeration(graph);
  for (const test::Enumerated& one : enumeration.all()) {
    TinyCounts counts;
    bool within = true;
    for (const auto& [rule, n] : one.genes) {
      counts.genes += n;
      within &= !graph.rules[rule].limit || n <= *graph.rules[rule].limit;
    }
    // Forked Twigs are told by their letter: three slots follow "edge.1".
    for (std::size_t at = 0; (at = one.key.find(".1", at)) != std::string::npos; ++at) ++counts.forks;
    if (!within || counts.genes > most_genes) continue;
    const auto of_rule = [&](RuleId rule) { return one.genes.contains(rule) ? one.genes.at(rule) : 0; };
    counts.twigs = of_rule(1), counts.buds = of_rule(2);
    density[one.key] += one.probability * weight(counts);
  }
  return density;
}

/// With the weight exp(beta * score).
inline std::map<std::string, double> tiny_posterior(const GeneratorGraph& graph, double beta, std::size_t most_genes) {
  // Each Twig has a draw u: the integral of exp(beta u) over 0..1.
  const double draw = (std::exp(beta) - 1) / beta;
  return tiny_density(graph, most_genes, [&](const TinyCounts& c) {
    return std::exp(beta * tiny_score(c.genes, c.buds, c.forks)) * std::pow(draw, c.twigs);
  });
}

}  // namespace espalier::testing
