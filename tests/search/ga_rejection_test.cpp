// What the scorer finds not acceptable never enters a population.
#include <cmath>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "search/engine_log.h"
#include "search/ga.h"
#include "search/test_graph.h"

namespace espalier {
namespace {

using testing::buds_in;
using testing::ChoosyScorer;
using testing::count_of;
using testing::log_of;
using testing::twig_graph;

GaSettings small_settings() {
  GaSettings s;
  s.population = 31;
  s.elitism = 4;
  s.initial_length_min = 10;
  s.initial_length_max = 20;
  s.genes = {4, 40};
  return s;
}

bool few_buds(const Derivation& derivation) { return buds_in(derivation) <= 5; }
bool nothing(const Derivation&) { return false; }

struct Bench {
  explicit Bench(ChoosyScorer::Rule rule = few_buds, const GaSettings& settings = small_settings())
      : scorer(std::move(rule)), engine({twig_graph(), {}, &scorer, 1, 0}, settings) {}

  ChoosyScorer scorer;
  GaEngine engine;
};

void expect_all_acceptable(const Bench& bench) {
  ASSERT_EQ(bench.engine.population().size(), 31u);
  for (const Individual& individual : bench.engine.population()) {
    ASSERT_TRUE(std::isfinite(individual.score));
    ASSERT_TRUE(bench.scorer.accepts(individual.derivation));
    ASSERT_EQ(individual.score, testing::BudScorer::score_of(individual.derivation));
  }
  EXPECT_TRUE(bench.scorer.accepts(bench.engine.best().derivation));
}

// Rejections and redraws of every kind add up to what the scorer saw.
void expect_counts_to_add_up(const Bench& bench) {
  EXPECT_EQ(bench.engine.evaluations(), bench.scorer.asked);
  EXPECT_EQ(count_of(bench.engine, "rejected children") + count_of(bench.engine, "rejected starts"),
            bench.scorer.rejected);
}

TEST(GaRejection, NoMemberOfAnyGenerationIsRejected) {
  for (const bool unique : {false, true}) {
    for (const bool reuse : {false, true}) {
      GaSettings settings = small_settings();
      settings.unique = unique;
      settings.reuse_scores = reuse;
      Bench bench(few_buds, settings);
      for (int step = 0; step < 40; ++step) {
        bench.engine.step();
        expect_all_acceptable(bench);
      }
      EXPECT_GT(bench.scorer.rejected, 100u);
      EXPECT_GT(bench.engine.best().score, 4.5);  // the search climbs to the limit
      expect_counts_to_add_up(bench);
    }
  }
}

TEST(GaRejection, UniqueHoldsAmongTheRedrawn) {
  GaSettings settings = small_settings();
  settings.unique = true;
  Bench bench(few_buds, settings);
  bench.engine.step();
  for (int step = 0; step < 20; ++step) {
    bench.engine.step();
    if (count_of(bench.engine, "kept parents") > 0) break;
    std::set<std::uint64_t> children;
    for (const Individual& individual : bench.engine.population()) children.insert(hash(individual.derivation));
    EXPECT_GE(children.size(), 31u - 3u);  // the elite of the first population may hold twins
  }
}

TEST(GaRejection, WhatIsAlwaysAcceptedChangesNothing) {
  testing::BudScorer plain;
  GaEngine engine({twig_graph(), {}, &plain, 1, 0}, small_settings());
  Bench bench([](const Derivation&) { return true; });
  EXPECT_EQ(log_of(engine, 15), log_of(bench.engine, 15));
}

TEST(GaRejection, SameSeedSameCourse) {
  Bench a, b;
  EXPECT_EQ(log_of(a.engine, 20), log_of(b.engine, 20));
}

TEST(GaRejection, SavedAndLoadedGoesOnAsIfNeverStopped) {
  GaSettings settings = small_settings();
  settings.unique = settings.reuse_scores = true;
  settings.restart_after = 3;
  testing::expect_saved_states_go_on([&] { return std::make_unique<Bench>(few_buds, settings); }, {0, 1, 7, 20}, 15);
}

TEST(GaRejection, RareStartsAreCopiedToFillThePopulation) {
  Bench bench([](const Derivation& d) { return hash(d) % 500 == 0; });
  bench.engine.step();
  expect_all_acceptable(bench);
  EXPECT_GT(count_of(bench.engine, "copied starts"), 0u);
  EXPECT_GT(count_of(bench.engine, "rejected starts"), 1000u);
  expect_counts_to_add_up(bench);
}

TEST(GaRejection, StartsOfOtherLengthsAreTriedWhereThoseAskedForAreRejected) {
  GaSettings settings = small_settings();
  settings.initial_length_min = settings.initial_length_max = 20;
  for (const bool longer : {false, true}) {
    Bench bench([&](const Derivation& d) { return longer ? d.size() > 25 : d.size() < 8; }, settings);
    bench.engine.step();
    expect_all_acceptable(bench);
    EXPECT_EQ(count_of(bench.engine, "copied starts"), 0u);
  }
}

TEST(GaRejection, WhereNothingIsAcceptableItEndsInAnError) {
  Bench bench(nothing);
  try {
    bench.engine.step();
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "none of 1550 models grown from grammar twigs is acceptable: it is choosy");
  }
  EXPECT_EQ(bench.scorer.asked, 31u * kMostStartRounds);
}

TEST(GaRejection, WhereNoChildIsAcceptableParentsAreKept) {
  Bench bench;
  bench.engine.step();
  const std::uint64_t before = bench.scorer.asked;
  bench.scorer.accepts = nothing;
  bench.engine.step();
  // Copies of parents have their scores and are kept too.
  EXPECT_GT(count_of(bench.engine, "kept parents"), 0u);
  EXPECT_LE(bench.scorer.asked - before, 400u * 14);
  bench.scorer.accepts = few_buds;
  expect_all_acceptable(bench);
  expect_counts_to_add_up(bench);
}

TEST(GaRejection, ARestartThatFindsNothingGoesOnFromTheChampion) {
  GaSettings settings = small_settings();
  settings.restart_after = 1;
  Bench bench(few_buds, settings);
  bench.engine.step();
  const double best = bench.engine.best().score;
  bench.scorer.accepts = nothing;
  for (int step = 0; step < 4; ++step) bench.engine.step();
  EXPECT_GT(count_of(bench.engine, "restarts"), 0u);
  EXPECT_GT(count_of(bench.engine, "copied starts"), 0u);
  EXPECT_EQ(bench.engine.best().score, best);
  for (const Individual& individual : bench.engine.population()) EXPECT_TRUE(std::isfinite(individual.score));
}

}  // namespace
}  // namespace espalier
