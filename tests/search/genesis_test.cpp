#include "search/genesis.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "search/engine_log.h"
#include "search/start_draws.h"

namespace espalier {
namespace {

using testing::log_of;
using testing::NearScorer;
using testing::start_draws_graph;
using ::testing::HasSubstr;

SearchProblem problem_for(BatchScorer& scorer) {
  SearchProblem problem;
  problem.graph = start_draws_graph();
  problem.scorer = &scorer;
  problem.seed = 11;
  return problem;
}

std::string error_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Genesis, RefusesBadSettings) {
  NearScorer scorer;
  const auto rejection = [&](const std::function<void(GenesisSettings&)>& spoil) {
    GenesisSettings settings;
    spoil(settings);
    return error_of([&] { GenesisEngine(problem_for(scorer), settings); });
  };
  EXPECT_THAT(rejection([](auto& s) { s.population = 1; }), HasSubstr("population must be between 2 and 100000, got 1"));
  EXPECT_THAT(rejection([](auto& s) { s.gap = 0; }), HasSubstr("gap must be above 0 and at most 1, got 0"));
  EXPECT_THAT(rejection([](auto& s) { s.mutation = 2; }), HasSubstr("mutation"));
  EXPECT_THAT(rejection([](auto& s) { s.crossover = -1; }), HasSubstr("crossover"));
  EXPECT_THAT(rejection([](auto& s) { s.idle = 0; }), HasSubstr("idle"));
  EXPECT_THAT(rejection([](auto& s) { s.bits = {8, 8, 40, 8, 8}; }), HasSubstr("bits must be between 1 and 32, got 40"));
}

TEST(Genesis, SameSeedSameLogAndTheBestNeverFalls) {
  NearScorer scorer, again;
  GenesisEngine one(problem_for(scorer), {}), two(problem_for(again), {});
  EXPECT_EQ(log_of(one, 40), log_of(two, 40));
  NearScorer third;
  SearchProblem other = problem_for(third);
  other.seed = 12;
  GenesisEngine three(other, {});
  double best = -100;
  for (int i = 0; i < 60; ++i) {
    three.step();
    EXPECT_GE(three.population()[0].score, best) << "the elite was lost";
    best = three.population()[0].score;
    EXPECT_EQ(three.best_score(), best);
  }
  EXPECT_EQ(three.evaluations(), third.asked);
  EXPECT_LT(three.evaluations(), 60u * 50) << "what did not change is not scored again";
}

TEST(Genesis, FindsWhatIsWanted) {
  NearScorer scorer;
  GenesisEngine engine(problem_for(scorer), {});
  while (engine.evaluations() < 1000) engine.step();  // Genesis's own number of trials
  EXPECT_GT(engine.best_score(), -0.3);
  double random_best = -10;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    RandomStream random({3, Purpose::test, 0, i, 0});
    double score = 0;
    for (int k = 0; k < 4; ++k) score -= std::abs(random.next_unit() - 0.7);
    random_best = std::max(random_best, score);
  }
  EXPECT_GT(engine.best_score(), random_best);
}

TEST(Genesis, SavesLoadsAndGoesOnAsIfNeverStopped) {
  for (const int steps : {0, 1, 17}) {
    NearScorer scorer, again;
    GenesisSettings settings;
    settings.population = 12;
    settings.mutation = 0.01;
    GenesisEngine whole(problem_for(scorer), settings), loaded(problem_for(again), settings);
    log_of(whole, steps);
    std::stringstream state;
    whole.save(state);
    loaded.load(state);
    EXPECT_EQ(log_of(whole, 25), log_of(loaded, 25));
  }
}

TEST(Genesis, RefusesStatesThatAreNotItsOwn) {
  NearScorer scorer;
  GenesisEngine engine(problem_for(scorer), {});
  log_of(engine, 3);
  std::stringstream state;
  engine.save(state);
  const std::string text = state.str();
  GenesisSettings other;
  other.gray = false;
  GenesisEngine differs(problem_for(scorer), other);
  std::istringstream whole(text);
  EXPECT_NE(error_of([&] { differs.load(whole); }), "accepted");
  const std::string before = testing::gauges_of(engine);
  for (std::size_t length = 0; length < text.size(); length += 97) {
    std::istringstream cut(text.substr(0, length));
    EXPECT_NE(error_of([&] { engine.load(cut); }), "accepted") << length;
  }
  EXPECT_EQ(testing::gauges_of(engine), before);
}

TEST(Genesis, WhatIsNotAcceptableIsNeverKept) {
  NearScorer scorer(0.5);
  GenesisSettings settings;
  settings.mutation = 0.05;
  GenesisEngine engine(problem_for(scorer), settings);
  for (int i = 0; i < 30; ++i) {
    engine.step();
    for (const Individual& one : engine.population()) EXPECT_GE(one.derivation.draws[2], 0x80000000u);
  }
  EXPECT_EQ(engine.evaluations(), scorer.asked);
  NearScorer never(2);
  GenesisEngine hopeless(problem_for(never), {});
  EXPECT_THAT(error_of([&] { hopeless.step(); }), HasSubstr("none of 2500 models drawn from grammar draws"));
}

TEST(Genesis, BeginsAnewWhereNothingChangesAnyMore) {
  NearScorer scorer;
  GenesisSettings settings;
  settings.population = 4;
  settings.mutation = 0;
  GenesisEngine engine(problem_for(scorer), settings);
  double best = -100;
  for (int i = 0; i < 400; ++i) {
    engine.step();
    EXPECT_GE(engine.population()[0].score, best);
    best = engine.population()[0].score;
  }
  EXPECT_GT(engine.diagnostics().back().value, 2u);
  EXPECT_GT(engine.evaluations(), 100u);
}

TEST(Genesis, TakesFoundersAsTheyAreAndRefusesLocksOfItsOnlyGene) {
  NearScorer scorer;
  SearchProblem problem = problem_for(scorer);
  Individual founder;
  founder.derivation.genes.push_back({});
  founder.derivation.draws = {0xb3333333, 0xb3333333, 0xb3333333, 0xb3333333, 77};
  const Derivation* one[] = {&founder.derivation};
  scorer.score(one, std::span(&founder.score, 1));
  problem.founders = {founder};
  GenesisEngine engine(problem, {});
  for (int i = 0; i < 10; ++i) {
    engine.step();
    for (std::size_t k = 0; k < 4; ++k) {  // the fifth counts nothing
      EXPECT_EQ(engine.population()[0].derivation.draws[k], founder.derivation.draws[k]) << "no string is as good";
    }
  }
  for (const LockScope scope : {LockScope::subtree, LockScope::draws}) {
    problem.locks = {{{}, scope}};
    EXPECT_THAT(error_of([&] { GenesisEngine(problem, {}); }), HasSubstr("holds all draws of Tree"));
  }
  problem.locks = {{{}, LockScope::structure}};
  EXPECT_EQ(error_of([&] { GenesisEngine(problem, {}); }), "accepted");
}

}  // namespace
}  // namespace espalier
