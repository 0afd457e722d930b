// The options beyond the published algorithm: nudges, no twins, restarts.

#include <cmath>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "search/engine_log.h"
#include "search/ga.h"
#include "search/test_graph.h"

namespace espalier {
namespace {

GaSettings local_settings() {
  GaSettings s = ga_preset("ga-local");
  s.population = 30;
  s.elitism = 4;
  s.initial_length_min = s.initial_length_max = 10;
  s.genes = {4, 40};
  s.restart_after = 3;
  return s;
}

/// Few levels, so that populations stall.
class PlateauScorer final : public BatchScorer {
 public:
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      double buds = 0;
      for (const GeneRecord& gene : derivations[i]->genes) buds += gene.edge == testing::kTwigBud;
      scores[i] = std::floor(buds / 2);
    }
  }
  double optimum() const override { return 100; }
};

struct Bench {
  explicit Bench(const GaSettings& settings) : engine({testing::twig_graph(), {}, &scorer, 5, 0}, settings) {}
  std::uint64_t count(const std::string& name) const { return testing::count_of(engine, name); }
  PlateauScorer scorer;
  GaEngine engine;
};

TEST(GaLocal, NudgesAreMade) {
  Bench bench(local_settings());
  for (int i = 0; i < 10; ++i) bench.engine.step();
  EXPECT_GT(bench.count("nudged"), bench.count("altered"));
}

TEST(GaLocal, NoTwinsInAGeneration) {
  GaSettings settings = local_settings();
  settings.mutation = 0.05;  // crossing small trees makes many twins
  Bench bench(settings);
  for (int i = 0; i < 20; ++i) {
    bench.engine.step();
    std::set<std::uint64_t> seen;
    for (const Individual& individual : bench.engine.population()) seen.insert(hash(individual.derivation));
    EXPECT_EQ(seen.size() + bench.count("kept parents"), 30u);
  }
  EXPECT_GT(bench.count("redrawn twins"), 0u);
}

TEST(GaLocal, StalledPopulationsStartAnewAndTheBestIsKept) {
  Bench bench(local_settings());
  double best = -1e300;
  for (int i = 0; i < 200; ++i) {
    bench.engine.step();
    EXPECT_GE(bench.engine.best().score, best);
    best = bench.engine.best().score;
  }
  EXPECT_GT(bench.count("restarts"), 4u);
  GaSettings never = local_settings();
  never.restart_after = 0;
  Bench steady(never);
  for (int i = 0; i < 200; ++i) steady.engine.step();
  EXPECT_EQ(steady.count("restarts"), 0u);
}

// Every fourth population begins with the champions of those before, so the best ever is in it.
TEST(GaLocal, EveryFourthPopulationIsAReunion) {
  Bench bench(local_settings());
  std::uint64_t restarts = 0;
  int reunions = 0;
  for (int i = 0; i < 400; ++i) {
    bench.engine.step();
    if (bench.count("restarts") == restarts) continue;
    restarts = bench.count("restarts");
    if (restarts % 4 != 0) continue;
    ++reunions;
    EXPECT_EQ(bench.engine.population().front().score, bench.engine.best().score);
  }
  EXPECT_GE(reunions, 1);
}

TEST(GaLocal, GoesOnFromASavedStateBetweenRestarts) {
  Bench whole(local_settings()), first(local_settings()), second(local_settings());
  for (int i = 0; i < 37; ++i) whole.engine.step(), first.engine.step();
  EXPECT_GT(first.count("restarts"), 0u);
  std::stringstream state;
  first.engine.save(state);
  second.engine.load(state);
  for (int i = 0; i < 60; ++i) {
    whole.engine.step(), second.engine.step();
    for (std::size_t k = 0; k < whole.engine.population().size(); ++k)
      ASSERT_EQ(whole.engine.population()[k].derivation, second.engine.population()[k].derivation) << i;
  }
}

}  // namespace
}  // namespace espalier
