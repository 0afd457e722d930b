// Samplers that take the score itself as likelihood, against the enumerated posterior prior * score^beta.
#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "search/deviation.h"
#include "search/rjmcmc.h"
#include "search/smc.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::tiny_graph;

constexpr double kBound = testing::kLargeDeviation;
constexpr double kBase = 0.3, kOfDraw = 0.4;

/// kBase, one for every Bud, and something for every draw: above 0.
class PositiveScorer final : public BatchScorer {
 public:
  explicit PositiveScorer(double lift = 0) : lift_(lift) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      scores[i] = kBase + lift_;
      for (const GeneRecord& gene : derivations[i]->genes) scores[i] += graph_->edges[gene.edge].child == 2;
      for (const std::uint32_t draw : derivations[i]->draws) scores[i] += kOfDraw * draw * 0x1p-32;
    }
  }
  double optimum() const override { return 10; }

 private:
  std::shared_ptr<const GeneratorGraph> graph_ = tiny_graph();
  double lift_;
};

/// prior * score^beta, for beta 1 or 2; n draws have mean n / 2 and variance n / 12.
std::map<std::string, double> density(int beta) {
  return testing::tiny_density(*tiny_graph(), 1000, [&](const testing::TinyCounts& c) {
    const auto n = static_cast<double>(c.twigs);
    const double mean = kBase + static_cast<double>(c.buds) + kOfDraw * n / 2;
    return beta == 1 ? mean : mean * mean + kOfDraw * kOfDraw * n / 12;
  });
}

RjmcmcSettings chains() {
  RjmcmcSettings s;
  s.weight = ScoreWeight::ratio;
  s.chains = 20;
  s.temperatures = 2;
  s.temperature = 0.5;  // beta 2, and beta 1 in the hotter rung
  s.heat = 2;
  s.swap_every = 2;
  s.initial_length_min = s.initial_length_max = 1;
  s.genes = {1, 1000};
  return s;
}

double worst_deviation_of_chains(const RjmcmcSettings& settings, std::uint32_t rung, int true_beta) {
  constexpr int kBatches = 50, kSteps = 400;
  PositiveScorer scorer;
  const auto graph = tiny_graph();
  RjmcmcEngine engine({graph, {}, &scorer, 1, 0, {}}, settings);
  testing::Deviation deviation(testing::shares(density(true_beta)));
  for (int i = 0; i < 200; ++i) engine.step();
  for (int batch = 0; batch < kBatches; ++batch) {
    std::map<std::string, double> seen;
    for (int i = 0; i < kSteps; ++i) {
      engine.step();
      for (std::size_t c = 0; c < engine.population().size(); ++c) {
        if (engine.rung_of(c) == rung) seen[test::key_of(*graph, engine.population()[c].derivation)] += 1;
      }
    }
    deviation.add(testing::shares(seen));
  }
  return deviation.worst(0.003);
}

TEST(Ratio, ChainsKeepThePosterior) {
  EXPECT_LT(worst_deviation_of_chains(chains(), 0, 2), kBound);
  EXPECT_LT(worst_deviation_of_chains(chains(), 1, 1), kBound);
  RjmcmcSettings plain = chains();
  plain.temperatures = 1;
  plain.temperature = {};  // 1 is the default, whatever the optimum
  EXPECT_LT(worst_deviation_of_chains(plain, 0, 1), kBound);
}

TEST(Ratio, AnotherPowerWouldBeSeen) {
  EXPECT_GT(worst_deviation_of_chains(chains(), 0, 1), 2 * kBound);
  RjmcmcSettings exponential = chains();
  exponential.weight = ScoreWeight::exponential;
  EXPECT_GT(worst_deviation_of_chains(exponential, 0, 2), 2 * kBound);
}

/// Of the evidence and its part of every derivation, over many sweeps.
double worst_deviation_of_sweeps(const SmcSettings& settings, int true_beta) {
  PositiveScorer scorer;
  const auto graph = tiny_graph();
  SmcEngine engine({graph, {}, &scorer, 1, 0, {}}, settings);
  std::map<std::string, double> truth = density(true_beta);
  double total = 0;
  for (const auto& [key, value] : truth) total += value;
  truth["all"] = total;
  testing::Deviation deviation(truth);
  for (int sweep = 0; sweep < 1500; ++sweep) {
    do engine.step();
    while (!engine.sweep_is_over());
    std::map<std::string, double> one = {{"all", std::exp(engine.log_evidence())}};
    std::vector<double> weights;
    EXPECT_TRUE(normalise(engine.log_weights(), weights));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      one[test::key_of(*graph, engine.population()[i].derivation)] += weights[i] * one["all"];
    }
    deviation.add(one);
  }
  return deviation.worst(0.003 * total);
}

TEST(Ratio, SweepsEstimateThePosteriorWithoutBias) {
  for (const SlotOrder order : {SlotOrder::depth_first, SlotOrder::random}) {
    SmcSettings settings;
    settings.weight = ScoreWeight::ratio;
    settings.order = order;
    settings.particles = 40;
    settings.initial_length_min = settings.initial_length_max = 1;
    settings.genes = {1, 1000};
    EXPECT_LT(worst_deviation_of_sweeps(settings, 1), kBound);
    EXPECT_GT(worst_deviation_of_sweeps(settings, 2), 2 * kBound);
    settings.temperature = 0.5;
    EXPECT_LT(worst_deviation_of_sweeps(settings, 2), kBound);
  }
}

TEST(Ratio, ChainsNeedScoresAboveZero) {
  for (const double lift : {-0.3, -0.6}) {  // without Buds and draws 0, or below
    PositiveScorer scorer(lift);
    RjmcmcEngine engine({tiny_graph(), {}, &scorer, 1, 0, {}}, chains());
    try {
      for (int i = 0; i < 100; ++i) engine.step();
      FAIL();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("weight \"ratio\" needs scores above 0, got "));
    }
  }
}

}  // namespace
}  // namespace espalier
