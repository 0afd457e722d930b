// The kernel against its slow reference, voxel by voxel, on random models.

#include "score/reference_volume.h"

#include <gtest/gtest.h>

#include "score/score_models.h"
#include "score/volume_kernel.h"

namespace espalier {
namespace {

using namespace test;

struct Differences {
  std::uint64_t voxels = 0, covered = 0, different = 0, far = 0, outside = 0;
};

/// Does some part's surface pass within 1e-4 of a cell of the voxel's sample point?
bool near_a_surface(const VoxelGrid& grid, const MeshTable& meshes, const std::vector<Instance>& parts,
                    const double p[3]) {
  const Vec3 cell = grid.cell_size();
  for (const Instance& instance : parts) {
    const ReferencePart solid(meshes.ref(instance.mesh), meshes.mesh(instance.mesh), instance, cell);
    const bool here = solid.contains(p);
    for (int k = 0; k < 27; ++k) {
      const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
      double q[3];
      for (int i = 0; i < 3; ++i) q[i] = p[i] + 1e-4 * step[i] * double{cell[i]};
      if (solid.contains(q) != here) return true;
    }
  }
  return false;
}

void compare(const VoxelGrid& grid, const MeshTable& meshes, const std::vector<Instance>& parts, Differences& sum) {
  const VolumeKernel kernel(grid, make_solids(meshes), {});
  const ReferenceVolume reference(grid, meshes, {});
  VolumeScratch scratch(grid);
  kernel.draw(parts, VolumeView::full, scratch);
  std::uint64_t outside = 0;
  const std::vector<std::uint16_t> hits = reference.cover(parts, VolumeView::full, outside);
  sum.voxels += hits.size();
  const std::uint64_t counted = scratch.canvas.outside;
  sum.outside += outside > counted ? outside - counted : counted - outside;
  for (std::uint32_t z = 0; z < grid.cells[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.cells[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.cells[0]; ++x) {
        const std::uint16_t expected = hits[grid.index(x, y, z)];
        sum.covered += expected > 0;
        const bool once = scratch.canvas.once.get(x, y, z), twice = scratch.canvas.twice.get(x, y, z);
        if (once == (expected > 0) && twice == (expected > 1)) continue;
        ++sum.different;
        const double p[3] = {reference.sample(0, std::int32_t(x)), reference.sample(1, std::int32_t(y)),
                             reference.sample(2, std::int32_t(z))};
        sum.far += !near_a_surface(grid, meshes, parts, p);
      }
    }
  }
}

std::vector<Instance> random_model(std::uint32_t number, const VoxelGrid& grid, std::size_t count, float size) {
  Dice dice(number);
  std::vector<Instance> parts;
  const Vec3 margin = 0.15f * (grid.max - grid.min);
  for (std::size_t i = 0; i < count; ++i) {
    const Frame frame = random_frame(dice, grid.min - margin, grid.max + margin, size);
    const float top = dice.chance(0.2) ? 1.0f : dice.chance(0.2) ? 0.0f : dice.between(0, 1.6f);
    parts.push_back(part(static_cast<std::uint16_t>(dice.below(kShapes)), frame, top));
  }
  return parts;
}

void expect_alike(const Differences& d) {
  EXPECT_GT(d.covered, d.voxels / 500);
  EXPECT_LE(static_cast<double>(d.different), 1e-6 * static_cast<double>(d.voxels));
  EXPECT_EQ(d.far, 0u);
  EXPECT_LE(static_cast<double>(d.outside), 1e-6 * static_cast<double>(d.voxels));
  testing::Test::RecordProperty("different", static_cast<int>(d.different));
}

TEST(ReferenceVolume, KernelAgreesOnAThousandRandomModels) {
  const MeshTable meshes = test_meshes();
  Differences sum;
  for (std::uint32_t number = 0; number < 1000; ++number) {
    const VoxelGrid grid = {Vec3(0), Vec3(4, 4.8f, 6.4f), {40, 48, 64}};
    compare(grid, meshes, random_model(number, grid, 8, 2.5f), sum);
  }
  expect_alike(sum);
}

TEST(ReferenceVolume, KernelAgreesOnOddGrids) {
  const MeshTable meshes = test_meshes();
  Differences sum;
  for (std::uint32_t number = 0; number < 100; ++number) {
    Dice dice(number + 5000);
    const VoxelGrid grid = {Vec3(-3, 0, 1), Vec3(2, 7, 4),
                            {1 + dice.below(70), 1 + dice.below(70), 1 + dice.below(100)}};
    compare(grid, meshes, random_model(number + 6000, grid, 10, dice.between(0.3f, 9)), sum);
  }
  expect_alike(sum);
}

TEST(ReferenceVolume, KernelAgreesOnLargeGrids) {
  const MeshTable meshes = test_meshes();
  Differences sum;
  for (std::uint32_t number = 0; number < 20; ++number) {
    const VoxelGrid grid = {Vec3(-5, -5, -2), Vec3(5, 5, 18), {100, 200, 100}};
    compare(grid, meshes, random_model(number + 9000, grid, 50, 3.0f), sum);
  }
  expect_alike(sum);
}

TEST(ReferenceVolume, CountsWithTargetsAgree) {
  const MeshTable meshes = test_meshes();
  const VoxelGrid grid = {Vec3(0), Vec3(4, 4.8f, 6.4f), {40, 48, 64}};
  const std::vector<Mesh> targets = {box_mesh(Vec3(1.02f), Vec3(3.03f)), corner_mesh()};
  const ReferenceVolume reference(grid, meshes, targets);
  std::vector<BitGrid> bits;
  for (const std::vector<bool>& target : reference.targets()) {
    BitGrid& grid_bits = bits.emplace_back(40, 48, 64);
    for (std::uint32_t z = 0; z < 64; ++z) {
      for (std::uint32_t y = 0; y < 48; ++y) {
        for (std::uint32_t x = 0; x < 40; ++x) {
          if (target[grid.index(x, y, z)]) grid_bits.set(x, y, z);
        }
      }
    }
  }
  const VolumeKernel kernel(grid, make_solids(meshes), bits);
  VolumeScratch scratch(grid);
  VolumeCounts counts;
  for (std::uint32_t number = 0; number < 20; ++number) {
    const std::vector<Instance> parts = random_model(number, grid, 8, 1.6f);
    kernel.count(parts, VolumeView::full, scratch, counts);
    EXPECT_EQ(counts, reference.counts(parts, VolumeView::full)) << number;
  }
}

}  // namespace
}  // namespace espalier
