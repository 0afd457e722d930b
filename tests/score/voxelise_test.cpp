#include "score/voxelise.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "score/score_models.h"

namespace espalier {
namespace {

using namespace test;

const VoxelGrid kGrid = {Vec3(0), Vec3(10, 20, 40), {10, 20, 40}};

TEST(Voxelise, CountsABoxByHand) {
  const VoxelisedMesh v = voxelise(box_mesh(Vec3(1, 2, 3), Vec3(4, 10, 38)), kGrid);
  EXPECT_EQ(v.open_edges, 0u);
  EXPECT_EQ(v.voxels.count(), 3u * 8u * 35u);
  EXPECT_TRUE(v.voxels.get(1, 2, 3));
  EXPECT_TRUE(v.voxels.get(3, 9, 37));
  EXPECT_FALSE(v.voxels.get(4, 9, 37));
  EXPECT_FALSE(v.voxels.get(3, 10, 37));
  EXPECT_FALSE(v.voxels.get(3, 9, 38));
}

TEST(Voxelise, DecidesFacesOnCentresOneWay) {
  // All faces, and the diagonals of their triangles, run through voxel centres.
  EXPECT_EQ(voxelise(box_mesh(Vec3(1.5f), Vec3(6.5f)), kGrid).voxels.count(), 125u);
}

TEST(Voxelise, BoxesOfOneMeshThatShareAFaceAreSolid) {
  Mesh mesh = box_mesh(Vec3(1), Vec3(4));
  append(mesh, box_mesh(Vec3(4, 1, 1), Vec3(6, 4, 4)));
  EXPECT_EQ(voxelise(mesh, kGrid).voxels.count(), 5u * 9u);
}

TEST(Voxelise, NestedShellsAreHollow) {
  Mesh mesh = box_mesh(Vec3(1), Vec3(9));
  append(mesh, box_mesh(Vec3(3), Vec3(7)));
  EXPECT_EQ(voxelise(mesh, kGrid).voxels.count(), 512u - 64u);
}

TEST(Voxelise, ClipsToTheGrid) {
  EXPECT_EQ(voxelise(box_mesh(Vec3(-5), Vec3(100)), kGrid).voxels.count(), 8000u);
  EXPECT_EQ(voxelise(box_mesh(Vec3(-5), Vec3(-1)), kGrid).voxels.count(), 0u);
}

TEST(Voxelise, GuessesTheInsideOfAnOpenMesh) {
  Mesh lidless = box_mesh(Vec3(1, 2, 3), Vec3(4, 10, 38));
  std::erase_if(lidless.triangles, [&](const Triangle& t) {  // without the face at the upper end of z
    return lidless.positions[t[0]].z > 37 && lidless.positions[t[1]].z > 37 && lidless.positions[t[2]].z > 37;
  });
  ASSERT_EQ(lidless.triangles.size(), 10u);
  const VoxelisedMesh v = voxelise(lidless, kGrid);
  EXPECT_EQ(v.open_edges, 4u);
  EXPECT_EQ(v.voxels.count(), 3u * 8u * 35u);  // rays along x and y still see it whole
}

TEST(Voxelise, ASheetHasNoInside) {
  Mesh sheet;
  sheet.positions = {{1, 1, 5}, {9, 1, 6}, {9, 9, 7}, {1, 9, 6}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(voxelise(sheet, kGrid).voxels.count(), 0u);
}

TEST(Voxelise, ATurnedMeshIsAsLargeAsItsVolume) {
  Dice dice(3);
  Mesh mesh = corner_mesh();
  const Mat3 turn = random_rotation(dice);
  for (Vec3& p : mesh.positions) p = turn * p * 8.0f + Vec3(5, 10, 20);
  const VoxelGrid fine = {Vec3(0, 0, 10), Vec3(10, 20, 30), {80, 160, 160}};
  const double voxel = 1.0 / 512;
  EXPECT_NEAR(static_cast<double>(voxelise(mesh, fine).voxels.count()) * voxel, 0.75 * 512, 0.002 * 512);
}

TEST(VoxelGrid, DefaultIsTheBoxAndATenthInCubes) {
  const Mesh mesh = box_mesh(Vec3(0), Vec3(10, 20, 5));
  const VoxelGrid grid = default_grid(std::span(&mesh, 1), 1'000'000);
  EXPECT_LE(grid.cell_count(), 1'000'000u);
  EXPECT_GT(grid.cell_count(), 900'000u);
  const Vec3 cell = grid.cell_size();
  EXPECT_NEAR(cell.x, cell.y, 1e-5f);
  EXPECT_NEAR(cell.x, cell.z, 1e-5f);
  EXPECT_NEAR(grid.max.x - grid.min.x, 11, 1.01f * cell.x);
  EXPECT_NEAR(grid.max.y - grid.min.y, 22, 1.01f * cell.x);
  EXPECT_NEAR(0.5f * (grid.max.z + grid.min.z), 2.5f, 1e-5f);
  EXPECT_NO_THROW(validate(grid, "volume"));
}

TEST(VoxelGrid, RefusesWhatCannotBeCounted) {
  VoxelGrid grid = kGrid;
  grid.max.y = grid.min.y;
  EXPECT_THROW(validate(grid, "hull"), Error);
  grid = kGrid;
  grid.cells[2] = 0;
  EXPECT_THROW(validate(grid, "hull"), Error);
  grid.cells[2] = 5000;
  EXPECT_THROW(validate(grid, "hull"), Error);
  grid = {Vec3(0), Vec3(1), {1000, 1000, 100}};
  EXPECT_THROW(validate(grid, "hull"), Error);
  EXPECT_THROW(default_grid({}), Error);
}

}  // namespace
}  // namespace espalier
