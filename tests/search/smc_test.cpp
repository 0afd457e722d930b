#include "search/smc.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "search/deviation.h"
#include "search/engine_log.h"
#include "search/test_graph.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::BudScorer;
using testing::ChoosyScorer;
using testing::count_of;
using testing::log_of;
using testing::tiny_graph;
using testing::twig_graph;

SmcSettings small_settings(SlotOrder order = SlotOrder::random) {
  SmcSettings s;
  s.order = order;
  s.particles = 40;
  s.temperature = 1;
  s.initial_length_min = s.initial_length_max = 1;
  s.genes = {1, 1000};
  return s;
}

struct TinyBench {
  TinyBench(const SmcSettings& settings, std::uint32_t most_buds = 0, std::uint64_t seed = 1)
      : graph(tiny_graph(most_buds)), scorer(graph), engine({graph, {}, &scorer, seed, 0}, settings) {}
  void run_sweep() {
    do engine.step();
    while (!engine.sweep_is_over());
  }

  std::shared_ptr<const GeneratorGraph> graph;
  testing::TinyScorer scorer;
  SmcEngine engine;
};

/// How far the means of what sweeps estimate, the evidence and its part of every derivation, lie from the truth: the
/// largest distance in standard errors.
double worst_deviation(const SmcSettings& settings, std::uint32_t most_buds, double true_beta) {
  constexpr int kSweeps = 3000;
  TinyBench bench(settings, most_buds);
  std::map<std::string, double> truth = testing::tiny_posterior(*bench.graph, true_beta, settings.genes.max);
  double& evidence = truth["all"];
  for (const auto& [key, density] : std::map(truth)) evidence += key == "all" ? 0 : density;
  const double total = evidence;
  testing::Deviation deviation(truth);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bench.run_sweep();
    const double log_evidence = bench.engine.log_evidence();
    std::map<std::string, double> one;
    std::vector<double> weights;
    if (normalise(bench.engine.log_weights(), weights)) {
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const Individual& particle = bench.engine.population()[i];
        EXPECT_EQ(find_fault(*bench.graph, particle.derivation), "");
        one[test::key_of(*bench.graph, particle.derivation)] += weights[i] * std::exp(log_evidence);
      }
    }
    one["all"] = std::exp(log_evidence);
    deviation.add(one);
  }
  return deviation.worst(0.003 * total);
}

constexpr double kBound = testing::kLargeDeviation;

TEST(Smc, EstimatesThePosteriorAndItsEvidenceWithoutBias) {
  for (const SlotOrder order : {SlotOrder::depth_first, SlotOrder::random}) {
    EXPECT_LT(worst_deviation(small_settings(order), 0, 1), kBound);
  }
}

TEST(Smc, LimitsRejectAndNeverRenormalise) {
  for (const SlotOrder order : {SlotOrder::depth_first, SlotOrder::random}) {
    EXPECT_LT(worst_deviation(small_settings(order), 1, 1), kBound);
    SmcSettings few = small_settings(order);
    few.genes.max = 5;
    EXPECT_LT(worst_deviation(few, 0, 1), kBound);
  }
}

TEST(Smc, EveryResamplingSchemeIsUnbiased) {
  for (const Resampling scheme : {Resampling::stratified, Resampling::multinomial, Resampling::residual}) {
    SmcSettings settings = small_settings();
    settings.resampling = scheme;
    settings.resample_below = 1;
    EXPECT_LT(worst_deviation(settings, 0, 1), kBound) << name_of(scheme);
  }
}

TEST(Smc, EveryResamplingSchemeIsUnbiasedInOrderToo) {
  for (const Resampling scheme : {Resampling::systematic, Resampling::stratified, Resampling::multinomial,
                                  Resampling::residual}) {
    SmcSettings settings = small_settings(SlotOrder::depth_first);
    settings.resampling = scheme;
    settings.particles = 20;
    settings.resample_below = scheme == Resampling::residual ? 0.8 : 1;
    EXPECT_LT(worst_deviation(settings, 0, 1), kBound) << name_of(scheme);
  }
}

// Sweeps of every size of a schedule estimate the same evidence.
TEST(Smc, SchedulesDoNotBiasTheEvidence) {
  SmcSettings settings = small_settings();
  settings.particles = 5;
  settings.schedule = 1.7;
  settings.most_particles = 40;
  const auto graph = tiny_graph();
  double truth = 0;
  for (const auto& [key, density] : testing::tiny_posterior(*graph, 1, settings.genes.max)) truth += density;
  for (const double off : {0.0, 0.04}) {  // the test can fail: another evidence is told apart
    std::vector<testing::Deviation> of_sweep(6, testing::Deviation({{"all", truth * (1 + off)}}));
    for (std::uint64_t seed = 0; seed < 1500; ++seed) {
      TinyBench bench(settings, 0, seed);
      for (testing::Deviation& deviation : of_sweep) {
        bench.run_sweep();
        deviation.add({{"all", std::exp(bench.engine.log_evidence())}});
      }
    }
    double worst = 0;
    for (testing::Deviation& deviation : of_sweep) worst = std::max(worst, deviation.worst(0));
    EXPECT_EQ(worst > kBound, off > 0) << worst;
  }
}

TEST(Smc, NeverResamplingIsImportanceSampling) {
  SmcSettings settings = small_settings();
  settings.resample_below = 0;
  EXPECT_LT(worst_deviation(settings, 0, 1), kBound);
}

// The tests above can fail: a slightly other posterior is told apart.
TEST(Smc, ABrokenWeightWouldBeSeen) {
  EXPECT_GT(worst_deviation(small_settings(), 0, 1.1), 2 * kBound);
  SmcSettings settings = small_settings();
  settings.temperature = 1.1;
  EXPECT_GT(worst_deviation(settings, 0, 1), 2 * kBound);
}

TEST(Smc, SameSeedSameCourse) {
  TinyBench a(small_settings()), b(small_settings()), c(small_settings(), 0, 2);
  const std::string log = log_of(a.engine, 60);
  EXPECT_EQ(log, log_of(b.engine, 60));
  EXPECT_NE(log, log_of(c.engine, 60));
}

TEST(Smc, ASavedSweepGoesOnAsIfNeverStopped) {
  SmcSettings settings = small_settings();
  settings.genes.max = 6;  // some particles die
  settings.resample_below = 0.3;
  testing::expect_saved_states_go_on([&] { return std::make_unique<TinyBench>(settings); }, {0, 1, 3, 7, 12, 13, 14},
                                     25);
}

TEST(Smc, RefusesForeignStates) {
  TinyBench in_order(small_settings(SlotOrder::depth_first));
  testing::expect_foreign_states_refused([] { return std::make_unique<TinyBench>(small_settings()); }, in_order.engine,
                                         3);
}

TEST(Smc, TheBestIsAlwaysFinishedAndNeverForgotten) {
  BudScorer scorer;
  SmcSettings settings = small_settings();
  settings.genes = {4, 60};
  settings.initial_length_min = settings.initial_length_max = 10;
  settings.temperature = 0.05;
  SmcEngine engine({testing::with_bones(*twig_graph()), {}, &scorer, 3, 0}, settings);
  double best = -1e9;
  for (int i = 0; i < 120; ++i) {
    engine.step();
    EXPECT_GE(engine.best().score, best);
    best = engine.best().score;
    EXPECT_TRUE(is_finished(engine.best().derivation));
    EXPECT_EQ(engine.best().score, BudScorer::score_of(engine.best().derivation));
    EXPECT_GE(engine.best().derivation.size(), 4u);
    for (const Individual& particle : engine.population()) {
      EXPECT_LE(particle.derivation.size(), 60u);
      EXPECT_LE(particle.score, engine.population()[0].score);
      EXPECT_TRUE(!is_finished(particle.derivation) || particle.score <= best);
    }
    EXPECT_GE(engine.effective_particles(), i == 0 ? 0 : 1 - 1e-9);
  }
  EXPECT_EQ(engine.evaluations(), scorer.asked.size());
  EXPECT_GT(best, 8);
  EXPECT_GT(count_of(engine, "resamplings"), 0u);
}

TEST(Smc, SweepsThatAreTooLongAreClosed) {
  BudScorer scorer;
  SmcSettings settings = small_settings();
  settings.most_steps = 3;
  SmcEngine engine({testing::with_bones(*twig_graph()), {}, &scorer, 3, 0}, settings);
  for (int i = 0; i < 40; ++i) {
    engine.step();
    if (!engine.sweep_is_over()) continue;
    for (const Individual& particle : engine.population()) EXPECT_TRUE(is_finished(particle.derivation));
  }
  EXPECT_GE(count_of(engine, "sweeps"), 7u);
  EXPECT_GT(count_of(engine, "closed particles"), 0u);
}

TEST(Smc, TheScheduleGrowsToItsEnd) {
  SmcSettings settings = small_settings();
  settings.schedule = 1.5;
  settings.most_particles = 100;
  TinyBench bench(settings);
  std::vector<std::size_t> sizes;
  for (int i = 0; i < 5; ++i) {
    bench.run_sweep();
    sizes.push_back(bench.engine.population().size());
  }
  EXPECT_THAT(sizes, ::testing::ElementsAre(40, 60, 90, 100, 100));
}

TEST(Smc, RatiosNeedScoresAboveZero) {
  SmcSettings settings = small_settings();
  settings.weight = ScoreWeight::ratio;
  TinyBench bench(settings);
  try {
    bench.run_sweep();
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("weight \"ratio\" needs scores above 0, got -"));
  }
}

TEST(Smc, WhereNothingIsAcceptableSweepsFailButTheRunGoesOn) {
  int asked = 0;
  ChoosyScorer scorer([&](const Derivation& d) { return ++asked == 1 || d.size() > 10'000; });
  SmcEngine engine({twig_graph(), {}, &scorer, 3, 0}, small_settings());
  for (int i = 0; i < 10; ++i) engine.step();
  EXPECT_EQ(count_of(engine, "failed sweeps"), 10u);
  EXPECT_EQ(engine.population().size(), 1u);
  EXPECT_EQ(engine.log_evidence(), -std::numeric_limits<double>::infinity());
}

TEST(SmcSettings, AreChecked) {
  const auto message = [](auto change) {
    SmcSettings settings;
    change(settings);
    try {
      validate(settings);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](SmcSettings&) {}), "");
  EXPECT_EQ(message([](SmcSettings& s) { s.particles = 1; }), "particles must be between 2 and 1000000, got 1");
  EXPECT_EQ(message([](SmcSettings& s) { s.temperature = 0; }),
            "temperature must be between 1e-12 and 1000000000000, got 0");
  EXPECT_THAT(message([](SmcSettings& s) { s.resample_below = NAN; }), HasSubstr("resample_below"));
  EXPECT_THAT(message([](SmcSettings& s) { s.most_particles = 10; }), HasSubstr("most_particles"));
}

}  // namespace
}  // namespace espalier
