#include "search/ga.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "search/engine_log.h"
#include "search/test_graph.h"

namespace espalier {
namespace {

using testing::BudScorer;
using testing::count_of;
using testing::log_of;
using testing::stunted_graph;
using testing::twig_graph;

GaSettings small_settings() {
  GaSettings s;
  s.population = 31;  // odd beyond the elite: the last pair has one child
  s.elitism = 4;
  s.initial_length_min = 10;
  s.initial_length_max = 20;
  s.genes = {4, 40};
  return s;
}

struct Bench {
  explicit Bench(const GaSettings& settings = small_settings(), std::uint64_t seed = 1, std::uint32_t lane = 0)
      : engine({twig_graph(), {}, &scorer, seed, lane}, settings) {}

  BudScorer scorer;
  GaEngine engine;
};

TEST(Ga, SameSeedSameCourse) {
  Bench a, b;
  EXPECT_EQ(log_of(a.engine, 20), log_of(b.engine, 20));
}

TEST(Ga, SeedAndLaneChangeTheCourse) {
  Bench a, b(small_settings(), 2), c(small_settings(), 1, 1);
  const std::string log = log_of(a.engine, 3);
  EXPECT_NE(log, log_of(b.engine, 3));
  EXPECT_NE(log, log_of(c.engine, 3));
}

TEST(Ga, EveryIndividualIsValidScoredAndWithinTheLimits) {
  Bench bench;
  const auto graph = twig_graph();
  for (int step = 0; step < 15; ++step) {
    bench.engine.step();
    ASSERT_EQ(bench.engine.population().size(), 31u);
    for (const Individual& individual : bench.engine.population()) {
      EXPECT_EQ(find_fault(*graph, individual.derivation), "");
      EXPECT_EQ(individual.score, BudScorer::score_of(individual.derivation));
      EXPECT_GE(individual.derivation.size(), 4u);
      EXPECT_LE(individual.derivation.size(), 40u);
    }
  }
}

TEST(Ga, InitialLengthsCoverTheirRange) {
  GaSettings settings = small_settings();
  settings.population = 400;
  Bench bench(settings);
  bench.engine.step();
  std::set<std::size_t> lengths;
  for (const Individual& individual : bench.engine.population()) lengths.insert(individual.derivation.size());
  EXPECT_EQ(*lengths.begin(), 10u);
  EXPECT_EQ(*lengths.rbegin(), 20u);
  EXPECT_EQ(lengths.size(), 11u);
}

TEST(Ga, PopulationIsSortedAndTheBestNeverFalls) {
  Bench bench;
  double best = -1e9;
  for (int step = 0; step < 30; ++step) {
    bench.engine.step();
    const auto population = bench.engine.population();
    EXPECT_TRUE(std::is_sorted(population.begin(), population.end(),
                               [](const Individual& a, const Individual& b) { return a.score > b.score; }));
    EXPECT_GE(population.front().score, best);  // elitism
    best = population.front().score;
    EXPECT_EQ(bench.engine.best().score, best);
  }
}

TEST(Ga, TheEliteIsCopiedUnchanged) {
  Bench bench;
  bench.engine.step();
  for (int step = 0; step < 10; ++step) {
    std::vector<Derivation> elite;
    for (std::size_t i = 0; i < 4; ++i) elite.push_back(bench.engine.population()[i].derivation);
    bench.engine.step();
    for (const Derivation& derivation : elite) {
      EXPECT_TRUE(std::any_of(bench.engine.population().begin(), bench.engine.population().end(),
                              [&](const Individual& i) { return i.derivation == derivation; }));
    }
  }
}

TEST(Ga, WithoutElitismTheBestEverIsKeptApart) {
  GaSettings settings = small_settings();
  settings.elitism = 0;
  settings.first = settings.second = SelectionScheme::random;
  Bench bench(settings);
  double best = -1e9;
  bool fell = false;
  for (int step = 0; step < 40; ++step) {
    bench.engine.step();
    best = std::max(best, bench.engine.population().front().score);
    fell = fell || bench.engine.population().front().score < best;
    EXPECT_EQ(bench.engine.best().score, best);
    EXPECT_EQ(BudScorer::score_of(bench.engine.best().derivation), best);
  }
  EXPECT_TRUE(fell);
}

TEST(Ga, ClimbsToManyBuds) {
  Bench bench;
  bench.engine.step();
  const double start = bench.engine.best().score;
  for (int step = 0; step < 60; ++step) bench.engine.step();
  EXPECT_GT(bench.engine.best().score, start + 5);
  EXPECT_GT(bench.engine.best().score, 17);  // of at most 19 in 40 genes: each Bud needs a Twig
}

TEST(Ga, ScoresOneBatchPerStepAndNoUnchangedIndividual) {
  Bench bench;
  bench.engine.step();
  EXPECT_EQ(bench.engine.evaluations(), 31u);
  for (int step = 2; step <= 20; ++step) bench.engine.step();
  EXPECT_EQ(bench.scorer.batches, 20);
  EXPECT_EQ(bench.engine.evaluations(), bench.scorer.asked.size());
  EXPECT_EQ(bench.engine.evaluations(), 31u + 19 * 27 - count_of(bench.engine, "reused scores") -
                                            count_of(bench.engine, "kept parents"));
}

TEST(Ga, ReusingScoresChangesNoResultAndSavesEvaluations) {
  GaSettings settings = small_settings();
  settings.mutation = 0.05;  // small trees crossed often: many twins
  settings.genes = {2, 8};
  settings.initial_length_min = settings.initial_length_max = 5;
  Bench plain(settings);
  settings.reuse_scores = true;
  Bench reusing(settings);
  for (int step = 0; step < 20; ++step) {
    plain.engine.step(), reusing.engine.step();
    for (std::size_t i = 0; i < plain.engine.population().size(); ++i) {
      ASSERT_EQ(plain.engine.population()[i].score, reusing.engine.population()[i].score);
      ASSERT_EQ(plain.engine.population()[i].derivation, reusing.engine.population()[i].derivation);
    }
  }
  EXPECT_LT(reusing.engine.evaluations(), plain.engine.evaluations());
}

TEST(Ga, SharesOfVariationFollowTheSettings) {
  GaSettings settings = small_settings();
  settings.population = 1004;
  settings.genes = {1, 1000};  // no redraws
  settings.grow = 0.5, settings.cut = 0.3, settings.alter = 0.2;
  Bench bench(settings);
  for (int step = 0; step < 5; ++step) bench.engine.step();
  const double pairs = 4 * 500, mutants = 2 * 0.3 * pairs;
  EXPECT_NEAR(count_of(bench.engine, "crossed pairs"), 0.7 * pairs, 80);  // 4 standard deviations
  EXPECT_NEAR(count_of(bench.engine, "grown"), 0.5 * mutants, 100);
  EXPECT_NEAR(count_of(bench.engine, "cut"), 0.3 * mutants, 90);
  EXPECT_NEAR(count_of(bench.engine, "altered"), 0.2 * mutants, 80);
  EXPECT_EQ(count_of(bench.engine, "redrawn children"), 0u);
}

TEST(Ga, ChildrenBeyondTheLimitsAreRedrawn) {
  GaSettings settings = small_settings();
  settings.genes = {10, 12};
  settings.initial_length_min = settings.initial_length_max = 12;
  settings.grow = 1, settings.cut = settings.alter = 0;
  Bench bench(settings);
  for (int step = 0; step < 10; ++step) bench.engine.step();
  EXPECT_GT(count_of(bench.engine, "redrawn children"), 0u);
  for (const Individual& individual : bench.engine.population()) EXPECT_LE(individual.derivation.size(), 12u);
}

TEST(Ga, WhereNoChildIsEverAllowedParentsAreKept) {
  GaSettings settings = small_settings();
  settings.genes = {12, 12};
  settings.initial_length_min = settings.initial_length_max = 12;
  settings.mutation = 1, settings.grow = 1, settings.cut = settings.alter = 0;
  Bench bench(settings);
  bench.engine.step();
  bench.engine.step();
  EXPECT_EQ(count_of(bench.engine, "kept parents"), 27u);
  EXPECT_EQ(bench.engine.evaluations(), 31u);
}

TEST(Ga, FallsBackToAnotherMutationWhereTheDrawnOneDoesNotExist) {
  GaSettings settings = small_settings();
  settings.genes = {1, 8};
  settings.initial_length_min = settings.initial_length_max = 1;
  settings.mutation = 1, settings.grow = 0.001, settings.cut = 1, settings.alter = 0.001;
  Bench bench(settings);
  bench.engine.step();
  bench.engine.step();
  // Bare roots have nothing to cut and, without draws, nothing to alter.
  EXPECT_EQ(count_of(bench.engine, "cut"), 0u);
  EXPECT_GE(count_of(bench.engine, "mutation fallbacks"), 27u);
}

TEST(Ga, AGrammarWithNothingToVaryStandsStillWithoutNewEvaluations) {
  BudScorer scorer;
  GaSettings settings = small_settings();
  settings.genes = {2, 8};
  settings.initial_length_min = settings.initial_length_max = 8;
  settings.mutation = 1, settings.grow = settings.cut = 1, settings.alter = 0;
  GaEngine engine({stunted_graph(), {}, &scorer, 1, 0}, settings);
  for (int step = 0; step < 3; ++step) engine.step();
  EXPECT_EQ(engine.evaluations(), 31u);
  EXPECT_EQ(count_of(engine, "short starts"), 31u);
  EXPECT_GT(count_of(engine, "failed mutations"), 0u);
}

TEST(Ga, AGrammarBelowTheLimitsIsRefused) {
  BudScorer scorer;
  GaEngine engine({stunted_graph(), {}, &scorer, 1, 0}, small_settings());
  try {
    engine.step();
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("stunted grew no derivation of 4 to 40 genes"));
  }
}

TEST(Ga, BadSettingsAreRefused) {
  GaSettings settings = small_settings();
  settings.elitism = 31;
  BudScorer scorer;
  EXPECT_THROW(GaEngine({twig_graph(), {}, &scorer, 1, 0}, settings), Error);
}

TEST(GaState, SavedAndLoadedGoesOnAsIfNeverStopped) {
  testing::expect_saved_states_go_on([] { return std::make_unique<Bench>(); }, {0, 1, 7}, 10);
}

TEST(GaState, EveryTruncationIsRefusedAndLeavesTheEngineAlone) {
  Bench other_seed(small_settings(), 2);
  testing::expect_foreign_states_refused([] { return std::make_unique<Bench>(); }, other_seed.engine, 2);
}

TEST(GaState, FlippedBytesNeverGetThroughAsInvalidDerivations) {
  Bench saved;
  log_of(saved.engine, 2);
  std::stringstream state;
  saved.engine.save(state);
  const auto graph = twig_graph();
  for (std::size_t at = 0; at < state.str().size(); at += 31) {
    std::string bytes = state.str();
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    Bench target;
    std::istringstream in(bytes);
    try {
      target.engine.load(in);
    } catch (const Error&) {
      continue;
    }
    for (const Individual& i : target.engine.population()) ASSERT_EQ(find_fault(*graph, i.derivation), "") << at;
  }
}

TEST(GaState, AnotherSearchIsRefused) {
  Bench saved, other_seed(small_settings(), 2);
  GaSettings settings = small_settings();
  settings.alter = 0.11;
  Bench other_settings(settings);
  std::stringstream state;
  saved.engine.save(state);
  for (GaEngine* engine : {&other_seed.engine, &other_settings.engine}) {
    std::istringstream in(state.str());
    try {
      engine->load(in);
      FAIL();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("belongs to another search"));
    }
  }
}

}  // namespace
}  // namespace espalier
