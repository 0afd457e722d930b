#include "score/combined_objective.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "score/limit_target.h"
#include "score/score_models.h"
#include "score/volume_target.h"

namespace espalier {
namespace {

using namespace test;

VolumeSettings wanted_box() {
  VolumeSettings s;
  s.grid = {Vec3(0), Vec3(10), {10, 10, 10}};
  s.view = VolumeView::parts;
  s.meshes.push_back({"hull", box_mesh(Vec3(0), Vec3(4)), 1, std::nullopt});
  return s;
}

Derivation genes(std::size_t n) {
  Derivation derivation;
  derivation.genes.resize(n);
  return derivation;
}

std::unique_ptr<LimitTarget> gene_limit(const Limit& limit) {
  Limits limits;
  limits[Measure::genes] = limit;
  return std::make_unique<LimitTarget>(limits, test_meshes(), VolumeView::parts);
}

TEST(Objective, AddsItsTargetsUp) {
  Objective objective;
  EXPECT_EQ(objective.view(), TargetView::genes);
  objective.add(std::make_unique<VolumeTarget>(wanted_box(), test_meshes()), 0.5);
  objective.add(gene_limit({.from = 0, .to = 20, .weight = 10}));
  EXPECT_EQ(objective.view(), TargetView::parts);
  EXPECT_EQ(objective.optimum(), 32);
  Objective::Scratch scratch(objective);
  Model model;
  model.instances = {part(kBox, box_frame(Vec3(0), Vec3(4, 4, 3)))};
  EXPECT_EQ(objective.score(genes(10), model, scratch), 0.5 * 48 - 5);

  const Explanation e = objective.explain(genes(10), model, scratch);
  EXPECT_EQ(e.score, 19);
  EXPECT_EQ(e.percent, 100.0 * 19 / 32);
  EXPECT_EQ(e.words, "75 % filled, 0 % spilled, 0 % overlap; 10 genes: 10 genes over 0 genes, costs 5");
  EXPECT_EQ(e.targets.size(), 2u);
  double sum = 0;
  for (const Term& term : e.terms) sum += term.value;
  EXPECT_EQ(sum, 19);
}

TEST(Objective, RefusesNegativeWeights) {
  Objective objective;
  EXPECT_THROW(objective.add(gene_limit({}), -1), Error);
}

}  // namespace
}  // namespace espalier
