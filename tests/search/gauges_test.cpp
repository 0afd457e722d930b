// What engines tell of themselves: gauges, held against what can be counted from outside.
#include "search/gauges.h"

#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "search/engine_log.h"
#include "search/ga.h"
#include "search/ga_gains.h"
#include "search/hybrid.h"
#include "search/rjmcmc.h"
#include "search/smc.h"
#include "search/test_graph.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

using testing::BudScorer;
using testing::gauge_of;

/// Scores by a rule that may change.
class RuleScorer final : public BatchScorer {
 public:
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) scores[i] = rule(*derivations[i]);
  }
  double optimum() const override { return 100; }
  std::function<double(const Derivation&)> rule = [](const Derivation& d) { return static_cast<double>(d.size()); };
};

HybridSettings small_settings() {
  HybridSettings s;
  s.start.particles = 30;
  s.middle.population = 20;
  s.middle.elitism = 3;
  s.end.chains = 6;
  s.end.temperatures = 3;
  s.turn = 300;
  s.start.genes = s.middle.genes = s.end.genes = {1, 60};
  s.start.initial_length_min = s.middle.initial_length_min = s.end.initial_length_min = 10;
  s.start.initial_length_max = s.middle.initial_length_max = s.end.initial_length_max = 10;
  return s;
}

SearchProblem problem_for(BatchScorer& scorer) {
  return {testing::with_bones(*testing::twig_graph()), {}, &scorer, 4, 0, {}};
}

std::vector<std::string> names_of(const Engine& engine) {
  std::vector<std::string> names;
  for (const NamedGauge& gauge : engine.gauges()) names.push_back(gauge.name);
  return names;
}

TEST(Gauges, NamesAreTheSameFromBeginningToEnd) {
  BudScorer scorer;
  const HybridSettings settings = small_settings();
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<GaEngine>(problem_for(scorer), settings.middle));
  engines.push_back(std::make_unique<SmcEngine>(problem_for(scorer), settings.start));
  engines.push_back(std::make_unique<RjmcmcEngine>(problem_for(scorer), settings.end));
  engines.push_back(std::make_unique<HybridEngine>(problem_for(scorer), settings));
  for (const auto& engine : engines) {
    const std::vector<std::string> names = names_of(*engine);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (int i = 0; i < 300; ++i) {
      engine->step();
      ASSERT_EQ(names_of(*engine), names);
      for (const NamedGauge& gauge : engine->gauges()) ASSERT_FALSE(std::isinf(gauge.value)) << gauge.name;
    }
  }
}

TEST(Gauges, OfPopulationsAreWhatAnyoneCanCount) {
  BudScorer scorer;
  GaEngine engine(problem_for(scorer), small_settings().middle);
  EXPECT_TRUE(std::isnan(gauge_of(engine, "distinct")));
  EXPECT_TRUE(std::isnan(gauge_of(engine, "score deviation")));
  for (int i = 0; i < 20; ++i) engine.step();
  std::set<std::uint64_t> different;
  double genes = 0, sum = 0, squares = 0;
  for (const Individual& one : engine.population()) {
    different.insert(hash(one.derivation));
    genes += static_cast<double>(one.derivation.size()) / 20;
    sum += one.score, squares += one.score * one.score;
  }
  EXPECT_EQ(gauge_of(engine, "distinct"), static_cast<double>(different.size()) / 20);
  EXPECT_LT(gauge_of(engine, "distinct"), 1);
  EXPECT_NEAR(gauge_of(engine, "mean genes"), genes, 1e-12);
  EXPECT_NEAR(gauge_of(engine, "score deviation"), std::sqrt(squares / 20 - sum / 20 * sum / 20), 1e-9);
}

GaSettings only_growing() {
  GaSettings s = small_settings().middle;
  s.mutation = 1;
  s.cut = s.alter = 0;
  s.genes.max = 3000;
  return s;
}

TEST(GaGauges, TellHowManyChildrenAreBetterThanTheirParents) {
  RuleScorer scorer;
  GaEngine engine(problem_for(scorer), only_growing());
  engine.step();
  EXPECT_TRUE(std::isnan(gauge_of(engine, "better by grow"))) << "no child yet";
  for (int i = 0; i < 30; ++i) engine.step();
  EXPECT_EQ(gauge_of(engine, "better by grow"), 1);
  EXPECT_TRUE(std::isnan(gauge_of(engine, "better by cut")));
  EXPECT_TRUE(std::isnan(gauge_of(engine, "better by crossover")));
  // From now on nothing is better: the share falls by a twentieth with every generation.
  scorer.rule = [](const Derivation&) { return 0.0; };
  for (int i = 1; i <= 20; ++i) {
    engine.step();
    EXPECT_NEAR(gauge_of(engine, "better by grow"), 1 - i / 20.0, 1e-12);
  }
}

TEST(GaGauges, WhatIsNotAcceptableIsNotBetter) {
  RuleScorer scorer;
  GaEngine engine(problem_for(scorer), only_growing());
  engine.step();
  int asked = 0;
  scorer.rule = [&](const Derivation& d) { return ++asked % 4 == 0 ? static_cast<double>(d.size()) : kNotAcceptable; };
  for (int i = 0; i < 20; ++i) engine.step();
  EXPECT_NEAR(gauge_of(engine, "better by grow"), 0.25, 0.02);
}

TEST(GaGauges, CopiesAreNoChildren) {
  BudScorer scorer;
  GaSettings settings = small_settings().middle;
  settings.genes.min = 1;
  settings.initial_length_min = settings.initial_length_max = 2;
  GaEngine engine({testing::stunted_graph(), {}, &scorer, 4, 0, {}}, settings);
  for (int i = 0; i < 5; ++i) engine.step();
  EXPECT_TRUE(std::isnan(gauge_of(engine, "better by grow")));
}

TEST(SmcGauges, TellOfTheLastSweepThatEnded) {
  BudScorer scorer;
  SmcSettings settings = small_settings().start;
  settings.temperature = 1;
  SmcEngine engine(problem_for(scorer), settings);
  double evidence = NAN;
  int sweeps = 0;
  while (sweeps < 3) {
    engine.step();
    if (engine.sweep_is_over()) evidence = engine.log_evidence(), ++sweeps;
    EXPECT_EQ(std::isnan(gauge_of(engine, "log evidence")), sweeps == 0);
    EXPECT_TRUE(sweeps == 0 || gauge_of(engine, "log evidence") == evidence);
    EXPECT_EQ(gauge_of(engine, "living particles"), static_cast<double>(engine.population().size()));
    EXPECT_EQ(gauge_of(engine, "effective particles"), engine.effective_particles());
    std::set<std::uint64_t> different;
    for (const Individual& one : engine.population()) different.insert(hash(one.derivation));
    EXPECT_EQ(gauge_of(engine, "distinct"),
              static_cast<double>(different.size()) / static_cast<double>(engine.population().size()));
  }
}

TEST(SmcGauges, AFailedSweepHasNoEvidenceToTell) {
  RuleScorer scorer;
  SmcSettings settings = small_settings().start;
  SmcEngine engine(problem_for(scorer), settings);
  for (int i = 0; i < 2; ++i) {
    do engine.step();
    while (!engine.sweep_is_over());
    EXPECT_EQ(std::isfinite(gauge_of(engine, "log evidence")), i == 0);
    EXPECT_EQ(gauge_of(engine, "living particles") > 0, i == 0);
    scorer.rule = [](const Derivation&) { return kNotAcceptable; };
  }
}

TEST(RjmcmcGauges, RatesAreOfTheLastThousandSteps) {
  BudScorer scorer;
  RjmcmcSettings settings = small_settings().end;
  settings.temperature = 0.5;
  settings.anneal = 2;
  settings.anneal_every = 1000;
  RjmcmcEngine engine(problem_for(scorer), settings);
  EXPECT_EQ(gauge_of(engine, "temperature"), 0.5);
  const auto accepted = [&] { return engine.count(1, ProposalKind::slots).accepted; };
  const auto proposed = [&] { return engine.count(1, ProposalKind::slots).proposed; };
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(std::isnan(gauge_of(engine, "accepted slots, rung 1")));
    engine.step();
  }
  EXPECT_EQ(gauge_of(engine, "temperature"), 0.25);
  const std::uint64_t accepted_before = accepted(), proposed_before = proposed();
  const ProposalCount swaps_before = engine.swaps(1);
  for (int i = 0; i < 1000; ++i) engine.step();
  const double rate = static_cast<double>(accepted() - accepted_before) /
                      static_cast<double>(proposed() - proposed_before);
  const double swap_rate = static_cast<double>(engine.swaps(1).accepted - swaps_before.accepted) /
                           static_cast<double>(engine.swaps(1).proposed - swaps_before.proposed);
  for (int i = 0; i < 500; ++i) {
    EXPECT_EQ(gauge_of(engine, "accepted slots, rung 1"), rate);
    EXPECT_EQ(gauge_of(engine, "accepted swaps 1-2"), swap_rate);
    engine.step();
  }
  EXPECT_GT(rate, 0);
  EXPECT_LT(rate, 1);
  EXPECT_EQ(engine.gauges().size(), 2u + 5 * 3 + 2);
}

TEST(RjmcmcGauges, GoOnFromASavedState) {
  struct Bench {
    Bench() : engine(problem_for(scorer), small_settings().end) {}
    BudScorer scorer;
    RjmcmcEngine engine;
  };
  testing::expect_saved_states_go_on([] { return std::make_unique<Bench>(); }, {990, 1500}, 520);
}

TEST(RjmcmcGauges, LongLaddersAreToldInPart) {
  BudScorer scorer;
  RjmcmcSettings settings = small_settings().end;
  settings.chains = settings.temperatures = 500;
  RjmcmcEngine engine(problem_for(scorer), settings);
  EXPECT_EQ(engine.gauges().size(), 2 + 5 * RjmcmcEngine::kGaugeRungs + RjmcmcEngine::kGaugeRungs - 1);
}

TEST(HybridGauges, OnlyTheEngineThatRunsTells) {
  BudScorer scorer;
  HybridEngine engine(problem_for(scorer), small_settings());
  std::set<double> stages;
  for (int i = 0; i < 600; ++i) {
    engine.step();
    const double stage = gauge_of(engine, "stage");
    EXPECT_EQ(stage, static_cast<double>(engine.stage()));
    EXPECT_EQ(std::isnan(gauge_of(engine, "sosmc: distinct")), stage != 0);
    EXPECT_EQ(std::isnan(gauge_of(engine, "ga: distinct")), stage != 1);
    EXPECT_EQ(std::isnan(gauge_of(engine, "rjmcmc: temperature")), stage != 2);
    stages.insert(stage);
  }
  EXPECT_THAT(stages, ::testing::ElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace espalier
