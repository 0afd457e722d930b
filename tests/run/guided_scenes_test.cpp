// What goes beyond the paper, on the shipped scenes: each holds what it promises, and without it the scene does not.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/executor.h"
#include "io/mesh_import.h"
#include "model/expand.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"
#include "run/setup.h"
#include "search/guided.h"

namespace espalier {
namespace {

/// Of a shipped scene with some settings changed: the best model after so many particle-steps.
Model grow(const std::string& scene, std::vector<std::string> changes, std::uint64_t evaluations) {
  AssimpMeshSource source;
  const auto setup = set_up(load_scene(std::string(ESPALIER_SOURCE_DIR) + "/scenes/" + scene, {changes, {}}), source);
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor);
  GuidedEngine engine({setup->grammar.graph, {}, &scorer, setup->scene.seed, 0}, setup->scene.search.guided);
  do engine.step();
  while (engine.evaluations() < evaluations);
  Model model;
  Expander(setup->graph()).expand(engine.best().derivation, ExpandTo::parts, model);
  EXPECT_GT(model.bones.size(), 5u);
  return model;
}

Vec3 middle(const Bone& bone) { return 0.5f * (bone.from + bone.to); }

/// Mean distance of the crown's bones from the stem's axis, m.
double crown_radius(const Model& model) {
  double sum = 0;
  int count = 0;
  for (const Bone& bone : model.bones) {
    const Vec3 at = middle(bone);
    if (at.y < 1.2f) continue;
    sum += std::hypot(at.x, at.z), ++count;
  }
  return sum / std::max(count, 1);
}

TEST(GuidedScenes, ThicknessLetsACrownSpread) {
  const double thick = crown_radius(grow("guided-thickness.toml", {}, 60000));
  const double thin = crown_radius(grow("guided-thickness.toml", {"curves.curve.1.thickness=[0, 0]"}, 60000));
  EXPECT_GT(thick, 1.5 * thin);
}

/// The most bones in a cube of half a metre.
std::size_t thickest(const Model& model) {
  std::size_t most = 0;
  for (const Bone& bone : model.bones) {
    const auto cell = [](const Bone& b) { return glm::floor(2.0f * middle(b)); };
    most = std::max(most, static_cast<std::size_t>(std::count_if(model.bones.begin(), model.bones.end(), [&](const Bone& other) {
      return cell(other) == cell(bone);
    })));
  }
  return most;
}

TEST(GuidedScenes, DensityKeepsBonesFromCrowding) {
  const std::size_t spread = thickest(grow("guided-density.toml", {}, 60000));
  const std::size_t crowded = thickest(grow("guided-density.toml", {"curves.density.cost=0"}, 60000));
  EXPECT_GT(crowded, 2 * spread);
}

/// The greatest angle between two blades that stand next to each other, degrees.
double sharpest_turn(const Model& model) {
  double sharpest = 0;
  for (const Bone& a : model.bones) {
    for (const Bone& b : model.bones) {
      if (&a == &b || glm::length(a.from - b.from) > 0.36f) continue;
      const float cosine = glm::dot(glm::normalize(a.to - a.from), glm::normalize(b.to - b.from));
      sharpest = std::max(sharpest, 57.29577951308232 * std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0)));
    }
  }
  return sharpest;
}

TEST(GuidedScenes, BlendingHidesTheSeam) {
  const double blended = sharpest_turn(grow("guided-blend.toml", {}, 400000));
  const double nearest = sharpest_turn(grow("guided-blend.toml", {"curves.blend=false"}, 400000));
  EXPECT_LT(blended, 0.75 * nearest) << nearest;
}

/// How many bones have a point within the ball that guided-avoid.toml keeps free.
int bones_in_ball(const Model& model) {
  int inside = 0;
  for (const Bone& bone : model.bones) {
    bool in = false;
    for (int i = 0; i <= 20; ++i) {
      const Vec3 at = bone.from + static_cast<float>(i) / 20 * (bone.to - bone.from);
      in = in || glm::length(at - Vec3(0.1f, 2.6f, 0)) < 0.6f;
    }
    inside += in;
  }
  return inside;
}

TEST(GuidedScenes, AVolumeBesideCurvesIsKeptFree) {
  EXPECT_EQ(bones_in_ball(grow("guided-avoid.toml", {}, 20000)), 0);
  EXPECT_GT(bones_in_ball(grow("guided-avoid.toml", {"volume.mesh.0.fill=0"}, 20000)), 0);
}

/// What the silhouette of guided-crown.toml makes of a model that was grown with its weight as given: pixels.
double crown_score(const std::string& weight) {
  AssimpMeshSource source;
  const std::string file = std::string(ESPALIER_SOURCE_DIR) + "/scenes/guided-crown.toml";
  const auto asked = set_up(load_scene(file, {{"silhouette.0.weight=" + weight}, {}}), source);
  const auto judge = set_up(load_scene(file, {{"silhouette.0.weight=1", "curves.weight=0"}, {}}), source);
  const auto executor = make_serial_executor();
  SceneScorer scorer(asked->graph(), asked->objective, *executor);
  GuidedEngine engine({asked->grammar.graph, {}, &scorer, 1, 0}, asked->scene.search.guided);
  do engine.step();
  while (engine.evaluations() < 4000);
  SceneScorer silhouette(judge->graph(), judge->objective, *executor);
  const Derivation* const best = &engine.best().derivation;
  double score = 0;
  silhouette.score({&best, 1}, {&score, 1});
  return score;
}

TEST(GuidedScenes, ASilhouetteBesideCurvesIsFilled) {
  const double shaped = crown_score("25"), free = crown_score("0");
  EXPECT_GT(shaped, 0);
  EXPECT_GT(shaped, free + 50);
}

}  // namespace
}  // namespace espalier
