#include "search/hybrid.h"

#include <algorithm>
#include <map>
#include <memory>

#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "search/engine_log.h"
#include "search/test_graph.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

using testing::BudScorer;
using testing::count_of;
using testing::log_of;
using Stage = HybridEngine::Stage;

HybridSettings small_settings() {
  HybridSettings s;
  s.start.particles = 30;
  s.middle.population = 20;
  s.middle.elitism = 3;
  s.end.chains = 6;
  s.end.temperatures = 3;
  s.turn = 300;
  s.start.genes = s.middle.genes = s.end.genes = {4, 30};
  for (auto* length : {&s.start.initial_length_min, &s.start.initial_length_max, &s.middle.initial_length_min,
                       &s.middle.initial_length_max, &s.end.initial_length_min, &s.end.initial_length_max}) {
    *length = 10;
  }
  return s;
}

struct Bench {
  explicit Bench(const HybridSettings& settings = small_settings(), std::vector<Individual> founders = {})
      : engine({testing::with_bones(*testing::twig_graph()), {}, &scorer, 4, 0, std::move(founders)}, settings) {}

  BudScorer scorer;
  HybridEngine engine;
};

TEST(Hybrid, EnginesTakeTurnsAndNeverFallBack) {
  Bench bench;
  double best = -1e9;
  std::map<Stage, int> steps;
  Stage before = Stage::start;
  for (int i = 0; i < 600; ++i) {
    bench.engine.step();
    ASSERT_GE(bench.engine.best().score, best);
    best = bench.engine.best().score;
    ASSERT_TRUE(before == Stage::start || bench.engine.stage() != Stage::start);
    // Whoever takes over begins with the best so far.
    EXPECT_TRUE(bench.engine.stage() == before || bench.engine.population()[0].score == best);
    before = bench.engine.stage();
    ++steps[before];
    ASSERT_EQ(bench.engine.evaluations(), bench.scorer.asked.size());
  }
  EXPECT_GT(steps[Stage::start], 5);
  EXPECT_GT(steps[Stage::middle], 10);
  EXPECT_GT(steps[Stage::end], 100);
  EXPECT_GE(bench.engine.handovers(), 3u);
  EXPECT_EQ(count_of(bench.engine, "handovers"), bench.engine.handovers());
  EXPECT_EQ(count_of(bench.engine, "sosmc: sweeps"), 1u);
  EXPECT_GT(count_of(bench.engine, "ga: crossed pairs"), 0u);
  EXPECT_GT(count_of(bench.engine, "rjmcmc: jumps"), 0u);
}

TEST(Hybrid, TheStartGivesWayInTheMiddleOfASweep) {
  HybridSettings settings = small_settings();
  settings.start_evaluations = 100;
  Bench bench(settings);
  while (bench.engine.stage() == Stage::start) {
    bench.engine.step();
    ASSERT_LT(bench.engine.evaluations(), 1000u);
  }
  EXPECT_EQ(count_of(bench.engine, "sosmc: sweeps"), 0u);
  EXPECT_EQ(bench.engine.evaluations(), bench.scorer.asked.size());
  for (const Individual& one : bench.engine.population()) EXPECT_EQ(one.score, BudScorer::score_of(one.derivation));
}

// Scores that rise only where somebody asks for a large batch: in this world only the genetic algorithm gets on.
class BatchLovingScorer final : public BatchScorer {
 public:
  explicit BatchLovingScorer(bool large) : large_(large) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    const bool loved = (derivations.size() > 10) == large_;
    if (loved) ++level_;
    std::fill(scores.begin(), scores.end(), loved ? level_ : 0);
  }
  double optimum() const override { return 1e9; }

 private:
  bool large_;
  double level_ = 0;
};

// Whoever gets on has nearly all turns; the other is tried again more and more rarely.
TEST(Hybrid, TheOneThatGainsMoreGoesOn) {
  for (const bool large : {true, false}) {
    BatchLovingScorer scorer(large);
    HybridEngine engine({testing::with_bones(*testing::twig_graph()), {}, &scorer, 4, 0, {}}, small_settings());
    std::map<Stage, std::uint64_t> evaluations;
    std::uint64_t before = 0;
    while (engine.evaluations() < 100'000) {
      engine.step();
      evaluations[engine.stage()] += engine.evaluations() - before;
      before = engine.evaluations();
    }
    const Stage winner = large ? Stage::middle : Stage::end, loser = large ? Stage::end : Stage::middle;
    EXPECT_GT(evaluations[winner], 15 * evaluations[loser]) << large;
    EXPECT_GT(evaluations[loser], 5 * small_settings().turn) << "it had its chances";
  }
}

// Where nothing gains any more, RJMCMC begins anew, with models that no one had, and what is best stays.
TEST(Hybrid, WhereAllHaveStalledItBeginsAnew) {
  class FlatScorer final : public BatchScorer {
   public:
    void score(std::span<const Derivation* const>, std::span<double> scores) override {
      std::fill(scores.begin(), scores.end(), 1.0);
    }
    double optimum() const override { return 100; }
  } scorer;
  HybridEngine engine({testing::with_bones(*testing::twig_graph()), {}, &scorer, 4, 0, {}}, small_settings());
  while (count_of(engine, "fresh starts") == 0) {
    engine.step();
    ASSERT_LT(engine.evaluations(), 40 * small_settings().turn);
  }
  EXPECT_EQ(engine.stage(), Stage::end);
  const std::uint64_t began = engine.evaluations();
  while (engine.stage() == Stage::end) engine.step();
  EXPECT_GT(engine.evaluations(), began + 3 * small_settings().turn) << "until it has settled";
  while (count_of(engine, "fresh starts") < 3) engine.step();
  EXPECT_LT(engine.evaluations(), 80 * small_settings().turn);
  EXPECT_EQ(engine.best().score, 1);
}

TEST(Hybrid, SameSeedSameCourse) {
  Bench a, b;
  EXPECT_EQ(log_of(a.engine, 200), log_of(b.engine, 200));
}

TEST(Hybrid, ASavedSearchGoesOnAsIfNeverStopped) {
  testing::expect_saved_states_go_on([] { return std::make_unique<Bench>(); }, {0, 1, 8, 20, 60, 300}, 80);
}

TEST(Hybrid, RefusesForeignStates) {
  HybridSettings other = small_settings();
  other.end.heat = 3;  // of a stage that is not yet running: it would not be noticed later
  Bench changed(other);
  testing::expect_foreign_states_refused([] { return std::make_unique<Bench>(); }, changed.engine, 30);
}

TEST(Hybrid, StartsFromFounders) {
  Bench other;
  for (int i = 0; i < 300; ++i) other.engine.step();
  Bench bench(small_settings(), {other.engine.best()});
  bench.engine.step();
  EXPECT_GE(bench.engine.best().score, other.engine.best().score);
}

// Locks hold for every engine, in everything that it ever asks the scorer for.
class LockedScorer final : public BatchScorer {
 public:
  LockedScorer(const GeneratorGraph& graph, const Derivation& start, std::uint32_t locked)
      : graph_(graph), start_(start), path_(gene_path(graph, start, locked)), locked_(locked) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      scores[i] = BudScorer::score_of(*derivations[i]);
      const auto gene = find_gene(graph_, *derivations[i], path_);
      ++asked;
      kept += gene && slice(*derivations[i], *gene) == slice(start_, locked_);
    }
  }
  double optimum() const override { return 100; }
  std::uint64_t asked = 0, kept = 0;

 private:
  std::vector<GeneRecord> slice(const Derivation& d, std::uint32_t gene) const {
    return {d.genes.begin() + gene, d.genes.begin() + gene + 1 + d.genes[gene].genes_below};
  }
  const GeneratorGraph& graph_;
  const Derivation& start_;
  std::vector<std::uint16_t> path_;
  std::uint32_t locked_;
};

TEST(Hybrid, LocksHoldInEveryStage) {
  Bench other;
  for (int i = 0; i < 300; ++i) other.engine.step();
  const Individual founder = other.engine.best();
  const auto graph = testing::with_bones(*testing::twig_graph());
  std::uint32_t locked = 0;
  for (std::uint32_t g = 1; g < founder.derivation.size(); ++g) {
    if (founder.derivation.genes[g].genes_below >= 3) locked = g;
  }
  ASSERT_GT(locked, 0u);
  const Locks locks = {{gene_path(*graph, founder.derivation, locked), LockScope::subtree}};
  LockedScorer scorer(*graph, founder.derivation, locked);
  HybridEngine engine({graph, locks, &scorer, 4, 0, {founder}}, small_settings());
  while (engine.handovers() < 5) engine.step();
  EXPECT_GT(scorer.asked, 1000u);
  EXPECT_EQ(scorer.kept, scorer.asked);
}

TEST(HybridSettings, AreChecked) {
  HybridSettings settings;
  validate(settings);
  settings.turn = 0;
  EXPECT_THROW(validate(settings), Error);
  settings = {};
  settings.end.heat = 0;
  EXPECT_THROW(validate(settings), Error);
}

}  // namespace
}  // namespace espalier
