#include "score/volume_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "score/score_models.h"
#include "score/smootherstep.h"

namespace espalier {
namespace {

using namespace test;
using testing::ElementsAre;

/// A grid of 10 x 10 x 10 cubes of size 1; `wanted` is 4 x 4 x 4 = 64 voxels in a corner.
VolumeSettings settings(VolumeForm form = VolumeForm::linear) {
  VolumeSettings s;
  s.grid = {Vec3(0), Vec3(10), {10, 10, 10}};
  s.form = form;
  s.meshes.push_back({"wanted", box_mesh(Vec3(0), Vec3(4)), 1, std::nullopt});
  return s;
}

/// 32 inside, 48 covered, 16 overlapping, 8 outside.
std::vector<Instance> model() {
  return {part(kBox, box_frame(Vec3(0, 0, 0), Vec3(4, 4, 2))), part(kBox, box_frame(Vec3(4, 0, 0), Vec3(8, 4, 1))),
          part(kBox, box_frame(Vec3(0, 0, 0), Vec3(4, 4, 1))), part(kBox, box_frame(Vec3(-2, 0, 0), Vec3(0, 2, 2)))};
}

double sum_of(const std::vector<Term>& terms) {
  double sum = 0;
  for (const Term& term : terms) sum += term.value;
  return sum;
}

double score_of(const VolumeSettings& s) {
  const VolumeTarget target(s, test_meshes());
  const auto scratch = target.make_scratch();
  const VolumeCounts counts = target.counts(model(), *scratch);
  EXPECT_DOUBLE_EQ(sum_of(target.breakdown(counts)), target.evaluate(counts));
  Model m;
  m.instances = model();
  EXPECT_EQ(target.score(Derivation(), m, scratch.get()), target.evaluate(counts));
  return target.evaluate(counts);
}

TEST(VolumeTarget, CountsTheModel) {
  const VolumeTarget target(settings(), test_meshes());
  EXPECT_EQ(target.target_voxels(0), 64u);
  const VolumeCounts counts = target.counts(model(), *target.make_scratch());
  EXPECT_THAT(counts.inside, ElementsAre(32u));
  EXPECT_EQ(counts.covered, 48u);
  EXPECT_EQ(counts.spilled, 16u);
  EXPECT_EQ(counts.overlap, 16u);
  EXPECT_EQ(counts.hits, 64u);
  EXPECT_EQ(counts.outside, 8u);
}

TEST(VolumeTarget, LinearFormOf2017) {
  VolumeSettings s = settings();
  EXPECT_EQ(score_of(s), 32 - 16 - 8);
  s.overlap_weight = 0.5;
  EXPECT_EQ(score_of(s), 32 - 16 - 8 - 8);
  s.outside_weight = -2;
  EXPECT_EQ(score_of(s), 32 - 16 - 16 - 8);
  s.meshes[0].fill = 3;
  s.meshes[0].spill = -0.25;
  EXPECT_EQ(score_of(s), 96 - 4 - 16 - 8);
}

TEST(VolumeTarget, LinearFormSumsTheWeightsOfSeveralTargets) {
  VolumeSettings s = settings();
  s.meshes.push_back({"avoid", box_mesh(Vec3(4, 0, 0), Vec3(6, 10, 10)), -5, 0.0});  // 8 voxels of the model
  EXPECT_EQ(score_of(s), 32 - 16 - 8 - 40);
}

TEST(VolumeTarget, SmootherstepFormOf2016) {
  VolumeSettings s = settings(VolumeForm::smootherstep);
  s.meshes[0].fill = 2;
  s.meshes[0].spill = 15;
  EXPECT_EQ(score_of(s), 2 * smootherstep(32, 0, 64) - 15 * smootherstep(16 + 16 + 8, 0, 128));
  s.meshes[0].spill.reset();  // weight 1
  EXPECT_EQ(score_of(s), 2 * 0.5 - smootherstep(40, 0, 128));
}

TEST(VolumeTarget, SeparateOverlapForm) {
  VolumeSettings s = settings(VolumeForm::smootherstep_separate);
  s.overlap_weight = 4;
  EXPECT_EQ(score_of(s), 0.5 - smootherstep(24, 0, 192) - 4 * smootherstep(16, 0, 48));
}

TEST(VolumeTarget, OverlapByHits) {
  VolumeSettings s = settings();
  s.overlap_weight = 1;
  s.overlap_count = OverlapCount::hits;
  const VolumeTarget target(s, test_meshes());
  std::vector<Instance> thrice(3, part(kBox, box_frame(Vec3(0), Vec3(2))));
  const VolumeCounts counts = target.counts(thrice, *target.make_scratch());
  EXPECT_EQ(counts.overlap, 8u);
  EXPECT_EQ(target.evaluate(counts), 8 - 16);
}

TEST(VolumeTarget, AvoidScenesRewardBeingElsewhere) {
  VolumeSettings s = settings(VolumeForm::smootherstep_separate);
  s.meshes[0].fill = -120;
  s.meshes[0].spill = -1;
  const VolumeTarget target(s, test_meshes());
  EXPECT_EQ(target.optimum(), 1);
  VolumeCounts counts;
  counts.inside = {0};
  counts.covered = counts.spilled = 3 * 64;
  EXPECT_EQ(target.evaluate(counts), 1);
  EXPECT_EQ(target.describe(counts), "0 % of what to avoid hit, 100 % elsewhere, 0 % overlap");
}

TEST(VolumeTarget, OptimumIsReachedByTheTargetItself) {
  for (const VolumeForm form : {VolumeForm::linear, VolumeForm::smootherstep, VolumeForm::smootherstep_separate}) {
    VolumeSettings s = settings(form);
    s.meshes[0].fill = 2.5;
    const VolumeTarget target(s, test_meshes());
    const std::vector<Instance> whole = {part(kBox, box_frame(Vec3(0), Vec3(4)))};
    const VolumeCounts counts = target.counts(whole, *target.make_scratch());
    EXPECT_EQ(target.evaluate(counts), target.optimum());
    EXPECT_EQ(target.optimum(), form == VolumeForm::linear ? 160 : 2.5);
  }
}

TEST(VolumeTarget, LinearOptimumWeighsVoxelByVoxel) {
  VolumeSettings s = settings();  // 64 voxels worth 1
  s.meshes.push_back({"more", box_mesh(Vec3(2, 0, 0), Vec3(6, 4, 4)), 3, -0.5});  // overlaps by 32
  // Only wanted: 1 - 0.5; in both: 4; only more: 3 - 1.
  EXPECT_EQ(VolumeTarget(s, test_meshes()).optimum(), 32 * 0.5 + 32 * 4 + 32 * 2);
  s.meshes[1].fill = -9;
  EXPECT_EQ(VolumeTarget(s, test_meshes()).optimum(), 32 * 0.5);
}

TEST(VolumeTarget, ExplainsInWords) {
  const VolumeTarget target(settings(), test_meshes());
  const auto scratch = target.make_scratch();
  Model m;
  m.instances = model();
  const Explanation e = target.explain(Derivation(), m, scratch.get());
  EXPECT_EQ(e.words, "50 % filled, 33 % spilled, 33 % overlap, 11 % outside the grid");
  EXPECT_EQ(e.score, 8);
  EXPECT_EQ(e.optimum, 64);
  EXPECT_EQ(e.percent, 12.5);
  ASSERT_EQ(e.terms.size(), 4u);
  EXPECT_EQ(e.terms[0].name, "inside wanted");
  EXPECT_EQ(e.terms[0].count, 32);
  EXPECT_EQ(e.terms[0].of, 64);
}

TEST(VolumeTarget, NothingScoresNothing) {
  for (const VolumeForm form : {VolumeForm::linear, VolumeForm::smootherstep, VolumeForm::smootherstep_separate}) {
    VolumeSettings s = settings(form);
    s.overlap_weight = 1;
    const VolumeTarget target(s, test_meshes());
    const VolumeCounts counts = target.counts(std::vector<Instance>(), *target.make_scratch());
    EXPECT_EQ(target.evaluate(counts), 0);
    EXPECT_EQ(target.describe(counts), "0 % filled, 0 % spilled, 0 % overlap");
  }
}

TEST(VolumeTarget, TellsOfOpenMeshesAndRefusesEmptyOnes) {
  VolumeSettings s = settings();
  s.meshes[0].mesh.triangles.pop_back();
  EXPECT_THAT(VolumeTarget(s, test_meshes()).warnings(), ElementsAre(testing::HasSubstr("wanted is not closed")));
  s.meshes[0].mesh = box_mesh(Vec3(20), Vec3(30));
  EXPECT_THROW(VolumeTarget(s, test_meshes()), Error);
  s.meshes.clear();
  EXPECT_THROW(VolumeTarget(s, test_meshes()), Error);
}

TEST(VolumeTarget, RefusesBadWeights) {
  VolumeSettings s = settings();
  s.overlap_weight = -1;
  EXPECT_THROW(VolumeTarget(s, test_meshes()), Error);
  s = settings();
  s.meshes[0].fill = std::numeric_limits<double>::infinity();
  EXPECT_THROW(VolumeTarget(s, test_meshes()), Error);
}

}  // namespace
}  // namespace espalier
