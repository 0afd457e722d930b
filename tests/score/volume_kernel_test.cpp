#include "score/volume_kernel.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "score/reference_volume.h"
#include "score/score_models.h"

namespace espalier {
namespace {

using namespace test;

VoxelGrid unit_grid(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
  return {Vec3(0), Vec3(static_cast<float>(nx), static_cast<float>(ny), static_cast<float>(nz)), {nx, ny, nz}};
}

VolumeCounts count(const VoxelGrid& grid, const std::vector<Instance>& parts, std::vector<BitGrid> targets = {}) {
  const VolumeKernel kernel(grid, make_solids(test_meshes()), std::move(targets));
  VolumeScratch scratch(grid);
  VolumeCounts counts;
  kernel.count(parts, VolumeView::full, scratch, counts);
  return counts;
}

TEST(VolumeKernel, CountsABoxByHand) {
  const VolumeCounts counts = count(unit_grid(10, 10, 40), {part(kBox, box_frame(Vec3(1, 2, 3), Vec3(4, 6, 38)))});
  EXPECT_EQ(counts.covered, 3u * 4u * 35u);
  EXPECT_EQ(counts.spilled, 3u * 4u * 35u);
  EXPECT_EQ(counts.hits, 3u * 4u * 35u);
  EXPECT_EQ(counts.overlap, 0u);
  EXPECT_EQ(counts.outside, 0u);
}

TEST(VolumeKernel, CountsOverlapOncePerVoxelAndHitsPerPart) {
  const Instance box = part(kBox, box_frame(Vec3(1, 1, 1), Vec3(4, 4, 4)));
  const Instance shifted = part(kBox, box_frame(Vec3(3, 1, 1), Vec3(6, 4, 4)));
  const VolumeCounts counts = count(unit_grid(10, 10, 10), {box, box, shifted});
  EXPECT_EQ(counts.covered, 5u * 9u);
  EXPECT_EQ(counts.overlap, 3u * 9u);       // the voxels of the first two; one column of them a third time
  EXPECT_EQ(counts.hits - counts.covered, 9u * 9u - 5u * 9u);
}

TEST(VolumeKernel, CountsInsidePerTargetAndSpilledInNone) {
  BitGrid a(10, 10, 10), b(10, 10, 10);
  for (std::uint32_t z = 0; z < 10; ++z) a.set(1, 1, z), b.set(1, 1, z), b.set(2, 1, z);
  const Instance box = part(kBox, box_frame(Vec3(1, 1, 0), Vec3(5, 3, 4)));
  const VolumeCounts counts = count(unit_grid(10, 10, 10), {box}, {a, b});
  EXPECT_EQ(counts.inside, (std::vector<std::uint64_t>{4, 8}));
  EXPECT_EQ(counts.covered, 32u);
  EXPECT_EQ(counts.spilled, 24u);
}

TEST(VolumeKernel, BoxesThatTouchOnCentresDoNotOverlap) {
  const VoxelGrid grid = {Vec3(-5, -5, -2), Vec3(5, 5, 18), {100, 200, 100}};
  std::vector<Instance> parts;
  for (int i = 0; i < 8; ++i) {  // each face between them lies exactly on voxel centres
    const float x = -0.05f + 0.1f * static_cast<float>(i);
    parts.push_back(part(kBox, box_frame(Vec3(x, -1.025f, 0.1f), Vec3(x + 0.1f, 1.025f, 2.1f))));
  }
  const VolumeCounts counts = count(grid, parts);
  EXPECT_EQ(counts.overlap, 0u);
  EXPECT_EQ(counts.covered, 8u * 41u * 10u);  // a box of 41 cells from face to face, both on centres, covers 41
}

TEST(VolumeKernel, CountsBeyondTheGridUpToTheWindow) {
  const VoxelGrid grid = unit_grid(10, 20, 30);
  // Sticks out by 2 along x.
  EXPECT_EQ(count(grid, {part(kBox, box_frame(Vec3(-2, 0, 0), Vec3(3, 5, 5)))}).outside, 2u * 25u);
  // Twice: per part.
  const Instance out = part(kBox, box_frame(Vec3(12, 1, 1), Vec3(14, 3, 3)));
  EXPECT_EQ(count(grid, {out, out}).outside, 16u);
  // Larger than the window of three grids by three by three.
  const VolumeCounts all = count(grid, {part(kBox, box_frame(Vec3(-1000, -1000, -1000), Vec3(1000, 1000, 1000)))});
  EXPECT_EQ(all.covered, 6000u);
  EXPECT_EQ(all.outside, 26u * 6000u);
  // Beyond the window.
  EXPECT_EQ(count(grid, {part(kBox, box_frame(Vec3(100, 0, 0), Vec3(110, 5, 5)))}).outside, 0u);
}

TEST(VolumeKernel, FlatThingsCoverNothing) {
  Frame flat = box_frame(Vec3(1, 1, 1), Vec3(8, 8, 8));
  flat.basis[2] = Vec3(0);
  Frame rod = flat;
  rod.basis[1] = rod.basis[0];
  for (std::uint16_t mesh = 0; mesh < kShapes; ++mesh) {
    EXPECT_EQ(count(unit_grid(10, 10, 10), {part(mesh, flat)}).hits, 0u) << mesh;
    EXPECT_EQ(count(unit_grid(10, 10, 10), {part(mesh, rod)}).hits, 0u) << mesh;
  }
  EXPECT_EQ(count(unit_grid(10, 10, 10), {part(kQuad, box_frame(Vec3(1, 1, 1), Vec3(8, 8, 8)))}).hits, 0u);
}

TEST(VolumeKernel, SurvivesWhateverAFrameHolds) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const VoxelGrid grid = unit_grid(20, 20, 40);
  for (std::uint16_t mesh = 0; mesh < kShapes; ++mesh) {
    for (const float v : {nan, inf, -inf, 0.0f, 1e-38f, 1e-20f, 1e10f, 1e30f, 3e38f}) {
      for (int where = 0; where < 12; ++where) {
        Frame frame = box_frame(Vec3(2), Vec3(9));
        (where < 9 ? frame.basis[where / 3] : frame.origin)[where % 3] = v;
        const VolumeCounts counts = count(grid, {part(mesh, frame), part(mesh, frame, v)});
        EXPECT_LE(counts.covered, 16000u);
        EXPECT_LE(counts.outside + counts.hits, 2u * 27u * 16000u);
        if (!std::isfinite(v)) {
          EXPECT_EQ(counts.hits + counts.outside, 0u);
        }
      }
    }
  }
}

TEST(VolumeKernel, AHugeSolidFillsTheWindow) {
  for (const std::uint16_t mesh : {kBox, kCylinder, kCone, kSphere, kCylinder6, kGem, kCorner}) {
    Frame frame;
    Dice dice(mesh);
    frame.basis = random_rotation(dice) * Mat3(1e7f);
    frame.origin = Vec3(-1e6f, -2e6f, -0.5e6f);  // off the planes that meet in the middle of the L
    EXPECT_EQ(count(unit_grid(10, 9, 33), {part(mesh, frame)}).covered, 2970u) << mesh;
  }
}

/// All paths, by the bytes of both planes and all counts.
TEST(VolumeKernel, EveryInstructionSetGivesTheSameBytes) {
  const VoxelGrid grid = {Vec3(-1, -2, 0), Vec3(2, 2, 3), {37, 51, 70}};
  const MeshTable meshes = test_meshes();
  BitGrid target(37, 51, 70);
  for (std::uint32_t y = 0; y < 51; ++y) target.set(y % 37, y, y);
  const VolumeKernel kernel(grid, make_solids(meshes), {target});
  const std::vector<std::string> paths = kernel_paths();
  ASSERT_GE(paths.size(), 2u);
  for (std::uint32_t number = 0; number < 60; ++number) {
    Dice dice(number);
    std::vector<Instance> parts;
    for (int i = 0; i < 40; ++i) {
      const Frame frame = random_frame(dice, Vec3(-2, -3, -1), Vec3(3, 3, 4), number < 50 ? 1.0f : 60.0f);
      parts.push_back(part(static_cast<std::uint16_t>(dice.below(kShapes)), frame, dice.between(0, 1.5f)));
    }
    VolumeScratch first(grid);
    VolumeCounts first_counts;
    for (const std::string& path : paths) {
      use_kernel_path(path);
      VolumeScratch scratch(grid);
      VolumeCounts counts;
      kernel.draw(parts, VolumeView::full, scratch);
      if (path == paths[0]) first.canvas = scratch.canvas;
      EXPECT_EQ(scratch.canvas.once, first.canvas.once) << path;
      EXPECT_EQ(scratch.canvas.twice, first.canvas.twice) << path;
      kernel.sweep(scratch, counts);
      if (path == paths[0]) first_counts = counts;
      EXPECT_EQ(counts, first_counts) << path;
      EXPECT_EQ(scratch.canvas.once.count() + scratch.canvas.twice.count(), 0u) << "not cleared";
    }
    use_kernel_path("");
  }
}

TEST(VolumeKernel, ShowsPartsOrFull) {
  Instance rule = part(kBox, box_frame(Vec3(0), Vec3(1))), proxy = part(kBox, box_frame(Vec3(0), Vec3(2)));
  Instance detail = part(kBox, box_frame(Vec3(0), Vec3(3)));
  proxy.layer = Layer::proxy;
  detail.layer = Layer::detail;
  const VoxelGrid grid = unit_grid(4, 4, 4);
  const VolumeKernel kernel(grid, make_solids(test_meshes()), {});
  VolumeScratch scratch(grid);
  VolumeCounts counts;
  const std::vector<Instance> model = {rule, proxy, detail};
  kernel.count(model, VolumeView::parts, scratch, counts);
  EXPECT_EQ(counts.hits, 1u + 8u);
  kernel.count(model, VolumeView::full, scratch, counts);
  EXPECT_EQ(counts.hits, 1u + 27u);
}

}  // namespace
}  // namespace espalier
