#include "search/engine_state.h"

#include <sstream>

#include <gtest/gtest.h>

#include "derivation/sample.h"
#include "search/ga.h"
#include "search/test_graph.h"

namespace espalier {
namespace {

using testing::BudScorer;
using testing::twig_graph;

TEST(EngineState, ManyFoundersAreNoHindrance) {
  BudScorer scorer;
  GaSettings settings;
  settings.population = 1000;
  settings.genes = {1, 100};
  settings.initial_length_min = settings.initial_length_max = 5;
  GaEngine first({twig_graph(), {}, &scorer, 1, 0}, settings);
  first.step();
  std::vector<Individual> founders(first.population().begin(), first.population().end());
  for (std::size_t i = 0; i < founders.size(); ++i) founders[i].score += 1.0 / (3.0 + static_cast<double>(i));

  GaEngine engine({twig_graph(), {}, &scorer, 1, 0, founders}, settings);
  engine.step();
  std::stringstream state;
  engine.save(state);
  GaEngine again({twig_graph(), {}, &scorer, 1, 0, founders}, settings);
  again.load(state);
  EXPECT_EQ(again.best().derivation, engine.best().derivation);
}

TEST(EngineState, EveryFounderCounts) {
  BudScorer scorer;
  SearchProblem problem = {twig_graph(), {}, &scorer, 1, 0};
  RandomStream random({1, Purpose::initial, 0, 0, 0});
  for (int i = 0; i < 3; ++i) {
    problem.founders.push_back({seedling(*problem.graph, random), 1.0 * i});
    problem.founders.back().derivation.detail_seed = static_cast<std::uint64_t>(i);
  }
  const std::string before = fingerprint("ga", problem, "");
  EXPECT_EQ(fingerprint("ga", problem, ""), before);
  for (std::size_t i = 0; i < 3; ++i) {
    SearchProblem other = problem;
    other.founders[i].score += 1e-9;
    EXPECT_NE(fingerprint("ga", other, ""), before);
    other = problem;
    other.founders[i].derivation.detail_seed += 7;
    EXPECT_NE(fingerprint("ga", other, ""), before);
  }
  std::swap(problem.founders[0], problem.founders[1]);
  EXPECT_NE(fingerprint("ga", problem, ""), before);
}

}  // namespace
}  // namespace espalier
