#include "search/guided.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "search/deviation.h"
#include "search/engine_log.h"
#include "search/packing_scorer.h"
#include "search/score_weight.h"
#include "search/test_graph.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::count_of;
using testing::log_of;
using testing::tiny_graph;

/// Whole derivations, with a promise for each open slot that has nothing to do with what follows.
class HopefulScorer final : public GrowthScorer {
 public:
  explicit HopefulScorer(BatchScorer& scorer) : packing_(scorer) {}
  void begin(std::size_t places) override { packing_.begin(places); }
  void clear(std::size_t) override {}
  void grown(std::size_t, const GrowthPool&, ShootId) override {}
  void grown_again(std::size_t, ShootId, ShootId) override {}
  void follow(std::span<const std::uint32_t>) override {}
  void score(const GrowthPool& pool, std::span<const GrowingDerivation> growing, std::span<double> scores) override {
    packing_.score(pool, growing, scores);
  }
  void promise(const GrowthPool& pool, std::span<const GrowingDerivation> growing, std::span<double> promises) override {
    for (std::size_t i = 0; i < growing.size(); ++i) {
      promises[i] = 0;
      for (const BudId bud : growing[i].open) promises[i] += pool.bud(bud).slot == 0 ? 0.8 : -0.5;
      asked |= promises[i] != 0;
    }
  }
  double worth(ShootId) const override { return 0; }
  void renumber(const GrowthRenumbering&) override {}

  bool asked = false;

 private:
  PackingScorer packing_;
};

class HopefulBatch final : public BatchScorer {
 public:
  explicit HopefulBatch(std::shared_ptr<const GeneratorGraph> graph) : tiny_(std::move(graph)) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    tiny_.score(derivations, scores);
  }
  std::unique_ptr<GrowthScorer> make_growth_scorer() override { return std::make_unique<HopefulScorer>(*this); }
  double optimum() const override { return 10; }

 private:
  testing::TinyScorer tiny_;
};

GuidedSettings small_settings() {
  GuidedSettings s;
  s.particles = 40;
  s.last_particles = 12;
  s.steps = 60;
  s.regrow = false;
  s.heuristic = 0;
  s.genes = {1, 1000};
  return s;
}

template <typename Scorer>
struct GuidedBench {
  explicit GuidedBench(const GuidedSettings& settings, std::uint64_t seed = 1, std::vector<Individual> founders = {})
      : graph(tiny_graph()), scorer(graph), engine({graph, {}, &scorer, seed, 0, std::move(founders)}, settings) {}
  void run_sweep() {
    do engine.step();
    while (!engine.sweep_is_over());
  }

  std::shared_ptr<const GeneratorGraph> graph;
  Scorer scorer;
  GuidedEngine engine;
};
using TinyBench = GuidedBench<testing::TinyScorer>;
using HopefulBench = GuidedBench<HopefulBatch>;

/// How far the means of what sweeps estimate, the evidence and its part of every derivation, lie from the truth: the
/// largest distance in standard errors.
template <typename Bench>
double worst_deviation(const GuidedSettings& settings, double true_beta) {
  constexpr int kSweeps = 3000;
  Bench bench(settings);
  std::map<std::string, double> truth = testing::tiny_posterior(*bench.graph, true_beta, settings.genes.max);
  double total = 0;
  for (const auto& [key, density] : truth) total += density;
  truth["all"] = total;
  testing::Deviation deviation(truth);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bench.run_sweep();
    const double evidence = std::exp(bench.engine.log_evidence());
    std::map<std::string, double> one;
    std::vector<double> weights;
    EXPECT_TRUE(normalise(bench.engine.log_weights(), weights));
    EXPECT_EQ(weights.size(), bench.engine.population().size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Individual& particle = bench.engine.population()[i];
      EXPECT_EQ(find_fault(*bench.graph, particle.derivation), "");
      EXPECT_TRUE(is_finished(particle.derivation));
      one[test::key_of(*bench.graph, particle.derivation)] += weights[i] * evidence;
    }
    one["all"] = evidence;
    deviation.add(one);
  }
  return deviation.worst(0.003 * total);
}

constexpr double kBound = testing::kLargeDeviation;

TEST(Guided, SweepsEstimateThePosteriorAndItsEvidenceWithoutBias) {
  EXPECT_LT(worst_deviation<TinyBench>(small_settings(), 1), kBound);
  for (const Resampling scheme : {Resampling::stratified, Resampling::multinomial, Resampling::residual}) {
    GuidedSettings settings = small_settings();
    settings.resampling = scheme;
    EXPECT_LT(worst_deviation<TinyBench>(settings, 1), kBound) << name_of(scheme);
  }
}

// Whatever it promises, a heuristic that has faded changes only which particles are kept on the way.
TEST(Guided, AHeuristicDoesNotBias) {
  GuidedSettings settings = small_settings();
  settings.heuristic = 1;
  settings.heuristic_steps = 30;
  EXPECT_LT(worst_deviation<HopefulBench>(settings, 1), kBound);
  HopefulBench bench(settings);
  TinyBench without(settings);
  EXPECT_NE(log_of(bench.engine, 20), log_of(without.engine, 20));
}

TEST(Guided, ABrokenWeightWouldBeSeen) {
  EXPECT_GT(worst_deviation<TinyBench>(small_settings(), 1.1), 2 * kBound);
  GuidedSettings settings = small_settings();
  settings.temperature = 1.1;
  EXPECT_GT(worst_deviation<TinyBench>(settings, 1), 2 * kBound);
}

GuidedSettings rounds() {
  GuidedSettings settings = small_settings();
  settings.regrow = true;
  settings.regrow_particles = 5;
  settings.regrow_steps = 4;
  settings.steps = 12;
  return settings;
}

TEST(Guided, SameSeedSameCourse) {
  TinyBench a(rounds()), b(rounds()), c(rounds(), 2);
  const std::string log = log_of(a.engine, 200);
  EXPECT_EQ(log, log_of(b.engine, 200));
  EXPECT_NE(log, log_of(c.engine, 200));
}

TEST(Guided, ASavedSearchGoesOnAsIfNeverStopped) {
  testing::expect_saved_states_go_on([] { return std::make_unique<TinyBench>(rounds()); },
                                     {0, 1, 5, 11, 12, 13, 14, 17, 40, 41, 42, 43, 99}, 60);
  testing::expect_saved_states_go_on([] { return std::make_unique<TinyBench>(small_settings()); },
                                     {1, 3, 9, 10, 11, 12, 25}, 40);
}

TEST(Guided, RefusesForeignStates) {
  GuidedSettings other = rounds();
  other.regrow_steps = 5;
  TinyBench foreign(other);
  testing::expect_foreign_states_refused([] { return std::make_unique<TinyBench>(rounds()); }, foreign.engine, 15);
}

/// Genes that make something: all, in the tiny grammar.
TEST(Guided, RoundsImproveWhatSweepsFoundAndKeepToTheSteps) {
  GuidedSettings settings = rounds();
  settings.particles = settings.last_particles = 2;
  settings.steps = 5;
  TinyBench bench(settings);
  bench.run_sweep();
  const double swept = bench.engine.best_score();
  double best = swept;
  for (int i = 0; i < 400; ++i) {
    bench.engine.step();
    EXPECT_GE(bench.engine.best_score(), best);
    best = bench.engine.best_score();
    const Individual& found = bench.engine.best();
    EXPECT_EQ(find_fault(*bench.graph, found.derivation), "");
    EXPECT_LE(found.derivation.size(), 6u);  // the start gene, and one a step
    EXPECT_EQ(found.score, best);
    EXPECT_EQ(testing::tiny_score(*bench.graph, found.derivation), best);
  }
  EXPECT_GT(best, swept + 0.5);
  EXPECT_GT(count_of(bench.engine, "rounds that improved"), 3u);
  EXPECT_GT(count_of(bench.engine, "steps taken back"), 100u);
  EXPECT_EQ(count_of(bench.engine, "sweeps"), 1u);
}

TEST(Guided, ParticlesFallAsTheyShould) {
  GuidedSettings settings = small_settings();
  settings.particles = 11;
  settings.last_particles = 2;
  settings.steps = 10;
  TinyBench bench(settings);
  std::vector<std::uint64_t> asked;
  std::uint64_t before = 0;
  for (int i = 0; i < 3; ++i) {
    bench.engine.step();
    asked.push_back(bench.engine.evaluations() - before);
    before = bench.engine.evaluations();
  }
  EXPECT_EQ(asked[0], 11u);  // all of them grow at first
  EXPECT_LE(asked[1], 10u);
  EXPECT_LE(asked[2], 9u);
}

TEST(Guided, FoundersAreWhereItBegins) {
  TinyBench first(rounds());
  for (int i = 0; i < 300; ++i) first.engine.step();
  const Individual found = first.engine.best();
  TinyBench second(rounds(), 2, {found});
  second.engine.step();
  EXPECT_GE(second.engine.best_score(), found.score);
  EXPECT_EQ(count_of(second.engine, "sweeps"), 0u);
}

TEST(Guided, GenesHaveTheirBounds) {
  GuidedSettings settings = rounds();
  settings.genes = {4, 6};
  TinyBench bench(settings);
  for (int i = 0; i < 100; ++i) {
    bench.engine.step();
    if (bench.engine.best_score() == 0) continue;
    EXPECT_GE(bench.engine.best().derivation.size(), 4u);
    EXPECT_LE(bench.engine.best().derivation.size(), 6u);
  }
}

TEST(GuidedSettings, AreChecked) {
  const auto message = [](auto change) {
    GuidedSettings settings;
    change(settings);
    try {
      validate(settings);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](GuidedSettings&) {}), "");
  EXPECT_EQ(message([](GuidedSettings& s) { s.particles = 1; }), "particles must be between 2 and 1000000, got 1");
  EXPECT_THAT(message([](GuidedSettings& s) { s.last_particles = 200; }), HasSubstr("last_particles"));
  EXPECT_THAT(message([](GuidedSettings& s) { s.heuristic = NAN; }), HasSubstr("heuristic"));
  EXPECT_THAT(message([](GuidedSettings& s) { s.temperature = 0; }), HasSubstr("temperature"));
}

}  // namespace
}  // namespace espalier
