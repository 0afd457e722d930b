#include "search/rjmcmc.h"

#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "derivation/sample.h"
#include "search/deviation.h"
#include "search/engine_log.h"
#include "search/test_graph.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

using testing::BudScorer;
using testing::ChoosyScorer;
using testing::count_of;
using testing::log_of;
using testing::tiny_graph;
using testing::twig_graph;

RjmcmcSettings tiny_settings() {
  RjmcmcSettings s;
  s.chains = 20;
  s.temperatures = 4;
  s.heat = 6;
  s.temperature = 1;
  s.swap_every = 2;
  s.initial_length_min = s.initial_length_max = 1;
  s.genes = {1, 1000};
  return s;
}

struct TinyBench {
  explicit TinyBench(const RjmcmcSettings& settings, std::uint64_t seed = 1)
      : graph(tiny_graph()), scorer(graph), engine({graph, {}, &scorer, seed, 0}, settings) {}

  std::shared_ptr<const GeneratorGraph> graph;
  testing::TinyScorer scorer;
  RjmcmcEngine engine;
};

/// The shares of time that the chains of a rung spend in the derivations, against the posterior at its temperature: the
/// largest distance in standard errors (of batch means).
double worst_deviation(const RjmcmcSettings& settings, std::uint32_t rung, double true_beta) {
  constexpr int kBatches = 60, kSteps = 1200;
  TinyBench bench(settings);
  testing::Deviation deviation(
      testing::shares(testing::tiny_posterior(*bench.graph, true_beta, settings.genes.max)));
  for (int i = 0; i < 300; ++i) bench.engine.step();
  for (int batch = 0; batch < kBatches; ++batch) {
    std::map<std::string, double> share;
    double seen = 0;
    for (int i = 0; i < kSteps; ++i) {
      bench.engine.step();
      for (std::size_t c = 0; c < bench.engine.population().size(); ++c) {
        if (bench.engine.rung_of(c) != rung) continue;
        share[test::key_of(*bench.graph, bench.engine.population()[c].derivation)] += 1;
        ++seen;
      }
    }
    for (auto& [key, value] : share) value /= seen;
    deviation.add(share);
  }
  return deviation.worst(0.003);
}

constexpr double kBound = testing::kLargeDeviation;

double beta_at(const RjmcmcSettings& s, std::uint32_t rung) {
  return std::pow(s.heat, -static_cast<double>(rung) / (s.temperatures - 1));
}

TEST(Rjmcmc, EveryRungKeepsItsPosterior) {
  const RjmcmcSettings settings = tiny_settings();
  for (const std::uint32_t rung : {0u, 3u}) {
    EXPECT_LT(worst_deviation(settings, rung, beta_at(settings, rung)), kBound) << rung;
  }
}

TEST(Rjmcmc, PlainChainsKeepThePosterior) {
  RjmcmcSettings settings = tiny_settings();
  settings.temperatures = 1;
  settings.delayed = false;
  settings.choice = PlaceChoice::uniform;
  EXPECT_LT(worst_deviation(settings, 0, 1), kBound);
}

TEST(Rjmcmc, GeneLimitsCutThePosterior) {
  RjmcmcSettings settings = tiny_settings();
  settings.genes.max = 5;
  EXPECT_LT(worst_deviation(settings, 0, 1), kBound);
}

// The tests above can fail: chains at another temperature are told apart.
TEST(Rjmcmc, AnotherTemperatureWouldBeSeen) {
  const RjmcmcSettings settings = tiny_settings();
  EXPECT_GT(worst_deviation(settings, 0, 1.15), 2 * kBound);
  EXPECT_GT(worst_deviation(settings, 1, 1), 2 * kBound);
}

// Delayed rejection of draws alone, against the density of one draw: exp(beta u) on 0..1.
class OneDrawScorer final : public BatchScorer {
 public:
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) scores[i] = derivations[i]->draws[0] * 0x1p-32;
  }
  double optimum() const override { return 1; }
};

TEST(Rjmcmc, DelayedNudgesKeepThePosterior) {
  test::GraphBuilder b("one");
  b.rule("Root", 1);
  const auto graph = std::make_shared<GeneratorGraph>(b.build());
  OneDrawScorer scorer;
  RjmcmcSettings settings = tiny_settings();
  settings.temperatures = 1;
  settings.temperature = 0.2;
  settings.nudges = settings.slots = settings.jumps = 0;
  RjmcmcEngine engine({graph, {}, &scorer, 1, 0}, settings);
  constexpr int kBatches = 100, kSteps = 500;
  double sum = 0, squares = 0;
  for (int i = 0; i < 50; ++i) engine.step();
  for (int batch = 0; batch < kBatches; ++batch) {
    double mean = 0;
    for (int i = 0; i < kSteps; ++i) {
      engine.step();
      for (const Individual& one : engine.population()) mean += one.score / kSteps / settings.chains;
    }
    sum += mean, squares += mean * mean;
  }
  const double mean = sum / kBatches, error = std::sqrt((squares / kBatches - mean * mean) / kBatches);
  EXPECT_NEAR(mean, 1 / (1 - std::exp(-5)) - 0.2, 4 * error);
  EXPECT_LT(error, 0.001);
  EXPECT_GT(count_of(engine, "delayed nudges accepted"), 1000u);
}

TEST(Rjmcmc, LaddersAreGeometricAndAnnealingCoolsAll) {
  RjmcmcSettings settings = tiny_settings();
  settings.anneal = 2;
  settings.anneal_every = 10;
  settings.anneal_most = 7;
  TinyBench bench(settings);
  EXPECT_DOUBLE_EQ(bench.engine.beta(0), 1);
  EXPECT_NEAR(bench.engine.beta(0) / bench.engine.beta(3), 6, 1e-9);
  EXPECT_NEAR(bench.engine.beta(1) / bench.engine.beta(2), std::cbrt(6), 1e-9);
  for (int i = 0; i < 10; ++i) bench.engine.step();
  EXPECT_NEAR(bench.engine.beta(0), 2, 1e-9);
  for (int i = 0; i < 100; ++i) bench.engine.step();
  EXPECT_NEAR(bench.engine.beta(0), 7, 1e-9);
}

TEST(Rjmcmc, TheBestIsKeptAndLimitsHold) {
  int rejected = 0;
  ChoosyScorer scorer([&](const Derivation& d) {
    const bool good = testing::buds_in(d) <= 5;
    rejected += !good;
    return good;
  });
  RjmcmcSettings settings = tiny_settings();
  settings.genes = {4, 40};
  settings.initial_length_min = settings.initial_length_max = 10;
  settings.temperature = 0.1;
  RjmcmcEngine engine({twig_graph(), {}, &scorer, 3, 0}, settings);
  double best = -1e9;
  for (int i = 0; i < 400; ++i) {
    engine.step();
    EXPECT_GE(engine.best().score, best);
    best = engine.best().score;
    double above = best;
    for (const Individual& one : engine.population()) {
      ASSERT_EQ(find_fault(*twig_graph(), one.derivation), "");
      EXPECT_EQ(one.score, BudScorer::score_of(one.derivation));
      EXPECT_LE(one.score, above);
      above = one.score;
      EXPECT_GE(one.derivation.size(), 4u);
      EXPECT_LE(one.derivation.size(), 40u);
      EXPECT_LE(testing::buds_in(one.derivation), 5u);
    }
  }
  EXPECT_EQ(engine.evaluations(), scorer.asked);
  EXPECT_GT(best, 4.5);
  EXPECT_GT(rejected, 0);
}

TEST(Rjmcmc, SameSeedSameCourse) {
  TinyBench a(tiny_settings()), b(tiny_settings()), c(tiny_settings(), 2);
  const std::string log = log_of(a.engine, 60);
  EXPECT_EQ(log, log_of(b.engine, 60));
  EXPECT_NE(log, log_of(c.engine, 60));
}

TEST(Rjmcmc, SavedChainsGoOnAsIfNeverStopped) {
  testing::expect_saved_states_go_on([] { return std::make_unique<TinyBench>(tiny_settings()); }, {0, 1, 2, 9, 50}, 40);
}

TEST(Rjmcmc, RefusesForeignStates) {
  RjmcmcSettings hotter = tiny_settings();
  hotter.heat = 7;
  TinyBench other(hotter);
  testing::expect_foreign_states_refused([] { return std::make_unique<TinyBench>(tiny_settings()); }, other.engine, 3);
}

TEST(Rjmcmc, CountsAddUp) {
  RjmcmcSettings settings = tiny_settings();
  settings.temperature = 0.1;
  TinyBench bench(settings);
  for (int i = 0; i < 201; ++i) bench.engine.step();
  std::uint64_t proposed = 0;
  for (const char* kind : {"draws", "nudges", "slots", "jumps"}) proposed += count_of(bench.engine, kind);
  EXPECT_EQ(proposed, 20u * 200);
  EXPECT_LE(count_of(bench.engine, "delayed nudges"),
            count_of(bench.engine, "draws") - count_of(bench.engine, "draws accepted"));
  EXPECT_GT(count_of(bench.engine, "swaps 0-1 accepted"), 0u);
  EXPECT_EQ(count_of(bench.engine, "swaps 0-1"), 5u * 50);  // every fourth step, in five ladders
  EXPECT_GT(count_of(bench.engine, "rung 3 accepted"), count_of(bench.engine, "rung 0 accepted"));
}

TEST(RjmcmcSettings, AreChecked) {
  RjmcmcSettings settings;
  validate(settings);
  settings.temperatures = 17;
  EXPECT_THROW(validate(settings), Error);
  settings = {};
  settings.draws = settings.nudges = settings.slots = settings.jumps = 0;
  EXPECT_THROW(validate(settings), Error);
  settings = {};
  settings.heat = NAN;
  EXPECT_THROW(validate(settings), Error);
}

}  // namespace
}  // namespace espalier
