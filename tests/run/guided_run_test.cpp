// The guided engine on scenes: curves that are edited, and curves beside other targets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/executor.h"
#include "derivation/encode.h"
#include "io/mesh_import.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"
#include "run/setup.h"
#include "search/guided.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

/// The paper's tree; its second curve ends at `tip`.
std::unique_ptr<Setup> tree(const std::string& tip, const std::string& more = "") {
  const std::string text = "espalier = 1\ngrammar = \"guided-tree.esp\"\n[budget]\nevaluations = 1\n[search]\n"
                           "engine = \"guided\"\nparticles = 20\nlast_particles = 8\nsteps = 60\n"
                           "[limits.genes]\nmin = 1\nmax = 2000\n"
                           "[curves]\n[[curves.curve]]\npoints = [[0,0,0], [0,1,0], [1,1,1], [2,2,1]]\n"
                           "[[curves.curve]]\npoints = [[0,1,0], [0.5,2,1], [0,3,1], " + tip + "]\n" + more;
  AssimpMeshSource source;
  return set_up(parse_scene(text, "scene.toml", test::grammar_folder().string(), {}), source);
}

/// The best after so many particle-steps.
Individual search(const Setup& setup, SceneScorer& scorer, std::uint64_t seed, std::uint64_t evaluations,
                  std::vector<Individual> founders = {}) {
  GuidedEngine engine({setup.grammar.graph, {}, &scorer, seed, 0, std::move(founders)}, setup.scene.search.guided);
  do engine.step();
  while (engine.evaluations() < evaluations);
  return engine.best();
}

double score_of(SceneScorer& scorer, const Derivation& derivation) {
  const Derivation* const one = &derivation;
  double score = 0;
  scorer.score({&one, 1}, {&score, 1});
  return score;
}

TEST(GuidedRuns, WhatGrowsScoresAsTheWholeModel) {
  const auto setup = tree("[0,3,2]");
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor);
  ASSERT_NE(scorer.make_growth_scorer(), nullptr);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Individual best = search(*setup, scorer, seed, 3000);
    EXPECT_EQ(find_fault(setup->graph(), best.derivation), "");
    EXPECT_EQ(score_of(scorer, best.derivation), best.score);
    EXPECT_GT(best.score, 4000);  // about 80 a bone, where 160 is the most
  }
}

// After one curve was edited, what was found before is worth more than a new beginning: most of it still stands.
TEST(GuidedRuns, AWarmStartIsBetterAtEqualSteps) {
  const auto before = tree("[0,3,2]"), after = tree("[0.6,3.2,1.6]");
  const auto executor = make_serial_executor();
  SceneScorer scorer_before(before->graph(), before->objective, *executor);
  SceneScorer scorer(after->graph(), after->objective, *executor);
  int warmer = 0;
  constexpr int kSeeds = 20;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Individual found = search(*before, scorer_before, seed, 3000);
    found.score = score_of(scorer, found.derivation);
    const double warm = search(*after, scorer, seed, 600, {found}).score;
    const double cold = search(*after, scorer, seed, 600).score;
    warmer += warm > cold;
  }
  EXPECT_GE(warmer, 17);  // by chance alone: p = 0.0013
}

// Other wishes are met too; then whole models are scored.
TEST(GuidedRuns, MixesWithOtherTargets) {
  const auto setup = tree("[0,3,2]", "[limits.height]\nmax = 2.2\n");
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor);
  EXPECT_EQ(scorer.make_growth_scorer(), nullptr);
  const Individual best = search(*setup, scorer, 1, 2000);
  EXPECT_EQ(score_of(scorer, best.derivation), best.score);
  EXPECT_GT(best.score, 0);
}

}  // namespace
}  // namespace espalier
