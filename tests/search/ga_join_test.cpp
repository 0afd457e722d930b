// Joining what several children of one parent gained.

#include <sstream>

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "search/ga.h"
#include "search/test_graph.h"

namespace espalier {
namespace {

GaSettings joining() {
  GaSettings s = ga_preset("ga-large");
  s.population = 20;
  s.elitism = 2;
  s.initial_length_min = s.initial_length_max = 10;
  s.genes = {4, 4000};
  return s;
}

struct Bench {
  explicit Bench(const GaSettings& settings) : engine({testing::twig_graph(), {}, &scorer, 5, 0}, settings) {}
  std::uint64_t count(const std::string& name) const {
    for (const NamedCount& count : engine.diagnostics())
      if (count.name == name) return count.value;
    ADD_FAILURE() << name;
    return 0;
  }
  testing::BudScorer scorer;
  GaEngine engine;
};

TEST(GaJoin, JoinedChildrenAreValidScoredAndWithinTheLimits) {
  GaSettings settings = joining();
  settings.genes = {4, 60};
  Bench bench(settings);
  for (int i = 0; i < 60; ++i) {
    bench.engine.step();
    for (const Individual& individual : bench.engine.population()) {
      ASSERT_EQ(find_fault(*testing::twig_graph(), individual.derivation), "");
      ASSERT_LE(individual.derivation.size(), 60u);
      ASSERT_EQ(individual.score, testing::BudScorer::score_of(individual.derivation));
    }
  }
  EXPECT_EQ(bench.engine.evaluations(), bench.scorer.asked.size()) << "joined children are counted too";
  EXPECT_GT(bench.count("better joins"), 10u);
  EXPECT_GE(bench.count("joined children"), bench.count("better joins"));
  EXPECT_GE(bench.count("joined changes"), 2 * bench.count("joined children"));
}

// Where every bud counts for itself, gains add up: one generation goes further.
TEST(GaJoin, LargeModelsGrowFasterForAsManyEvaluations) {
  GaSettings together = joining();
  together.mutation = 1;  // crossover copies what has many buds, and here that is good anywhere
  GaSettings apart = together;
  apart.join = false;
  Bench joined(together), single(apart);
  while (joined.engine.evaluations() < 4000) joined.engine.step();
  while (single.engine.evaluations() < 4000) single.engine.step();
  EXPECT_GT(joined.engine.best().score, 1.3 * single.engine.best().score);
  EXPECT_EQ(single.count("joined children"), 0u);
}

TEST(GaJoin, SameSeedSameCourseAndGoesOnFromASavedState) {
  Bench whole(joining()), first(joining()), second(joining());
  for (int i = 0; i < 20; ++i) whole.engine.step(), first.engine.step();
  std::stringstream state;
  first.engine.save(state);
  second.engine.load(state);
  for (int i = 0; i < 20; ++i) {
    whole.engine.step(), second.engine.step();
    ASSERT_EQ(whole.count("joined changes"), second.count("joined changes"));
    for (std::size_t k = 0; k < whole.engine.population().size(); ++k)
      ASSERT_EQ(whole.engine.population()[k].derivation, second.engine.population()[k].derivation) << i;
  }
}

// A child that is not acceptable scores -infinity; so may what is joined.
TEST(GaJoin, WhatIsNotAcceptableIsDropped) {
  testing::ChoosyScorer scorer([](const Derivation& d) { return testing::buds_in(d) % 4 != 3; });
  GaEngine engine({testing::twig_graph(), {}, &scorer, 5, 0}, joining());
  for (int i = 0; i < 40; ++i) {
    engine.step();
    for (const Individual& individual : engine.population()) ASSERT_NE(testing::buds_in(individual.derivation) % 4, 3u);
  }
}

}  // namespace
}  // namespace espalier
