// Triangles cut up by voxels: nothing lost, nothing twice, whatever lies on the planes.
#include "score/voxel_cutter.h"

#include <map>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "model/shell.h"
#include "score/score_models.h"

namespace espalier {
namespace {

using test::Dice;

Bounds box_of(const Vec3& low, const Vec3& high) {
  Bounds box;
  box.add(low), box.add(high);
  return box;
}

struct Cut {
  std::map<std::uint32_t, double> areas;
  std::vector<std::uint32_t> order;
};

Cut cut_up(const Subdivision& grid, const DVec3& a, const DVec3& b, const DVec3& c, std::uint32_t first = 0,
           std::uint32_t last = 99) {
  Cut result;
  VoxelCutter cutter(grid, first, last);
  cutter.cut_up(a, b, c, [&](std::uint32_t voxel, const Polygon& piece, double area) {
    EXPECT_DOUBLE_EQ(piece.area(), area);
    result.areas[voxel] += area;
    result.order.push_back(voxel);
    const std::uint32_t n = grid.layers(), at[] = {voxel % n, voxel / n % n, voxel / n / n};
    for (std::size_t i = 0; i < piece.count(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(piece[i][axis], grid.plane(axis, at[axis]));
        EXPECT_LE(piece[i][axis], grid.plane(axis, at[axis] + 1));
      }
    }
  });
  return result;
}

double sum_of(const Cut& cut) {
  double sum = 0;
  for (const auto& [voxel, area] : cut.areas) sum += area;
  return sum;
}

TEST(Subdivision, GrowsTheBoxByAThousandthAndCutsItEvenly) {
  const Subdivision grid(box_of(Vec3(-1, 0, 2), Vec3(3, 2, 10)), 4);
  EXPECT_DOUBLE_EQ(grid.plane(0, 0), -1.002);
  EXPECT_DOUBLE_EQ(grid.plane(0, 4), 3.002);
  EXPECT_DOUBLE_EQ(grid.plane(2, 2), 6);
  EXPECT_NEAR(grid.diagonal(), 1.001 * std::sqrt(1 + 0.25 + 4), 1e-12);
  EXPECT_EQ(grid.layer(0, -1.0), 0u);
  EXPECT_EQ(grid.layer(0, 3.0), 3u);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::uint32_t i = 1; i < 4; ++i) {
      const double plane = grid.plane(axis, i);
      EXPECT_EQ(grid.layer(axis, plane), i) << "the upper one";
      EXPECT_EQ(grid.layer(axis, std::nextafter(plane, -1e9)), i - 1);
    }
  }
}

TEST(Subdivision, DoesNotCutAlongFlatAxes) {
  const Subdivision grid(box_of(Vec3(0, 5, 0), Vec3(3, 5.000001f, 4)), 4);
  EXPECT_EQ(grid.layer(1, 5), 2u);
  EXPECT_EQ(grid.layer(1, 5.000001), 2u);
  EXPECT_NEAR(grid.diagonal(), 1.001 * 1.25, 1e-12);
  const Subdivision empty(Bounds(), 3);
  EXPECT_EQ(empty.diagonal(), 0);
  EXPECT_EQ(empty.voxel_count(), 27u);
}

TEST(VoxelCutter, LosesNoAreaOfRandomTriangles) {
  const Subdivision grid(box_of(Vec3(-1), Vec3(1)), 5);
  Dice dice(1);
  std::size_t most = 0;
  for (int n = 0; n < 2000; ++n) {
    DVec3 corner[3];
    for (DVec3& p : corner) p = DVec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    const Cut cut = cut_up(grid, corner[0], corner[1], corner[2]);
    EXPECT_NEAR(sum_of(cut), area(corner[0], corner[1], corner[2]), 1e-13);
    EXPECT_TRUE(std::is_sorted(cut.order.begin(), cut.order.end()));
    EXPECT_EQ(cut.areas.size(), cut.order.size()) << "one piece a voxel";
    most = std::max(most, cut.order.size());
  }
  EXPECT_GT(most, 30u);
}

TEST(VoxelCutter, KnownPieces) {
  // Half of a square over a 2 x 2 grid: two triangles of an eighth, and a square of a quarter.
  const Subdivision grid(box_of(Vec3(0), Vec3(1)), 2);
  const Cut cut = cut_up(grid, {0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1});
  ASSERT_EQ(cut.areas.size(), 3u);
  EXPECT_NEAR(cut.areas.at(grid.index(0, 0, 0)), 0.25, 1e-12);
  EXPECT_NEAR(cut.areas.at(grid.index(1, 0, 0)), 0.125, 1e-12);
  EXPECT_NEAR(cut.areas.at(grid.index(0, 1, 0)), 0.125, 1e-12);
}

TEST(VoxelCutter, FacesOnPlanesBelongToTheUpperVoxelOnce) {
  const Subdivision grid(box_of(Vec3(-2), Vec3(2)), 4);
  ASSERT_EQ(grid.plane(0, 2), 0);
  for (int axis = 0; axis < 3; ++axis) {
    DVec3 a(0.1), b(0.1), c(0.1);
    a[axis] = b[axis] = c[axis] = 0;
    b[(axis + 1) % 3] = 0.9, c[(axis + 2) % 3] = 0.9;
    const Cut inside = cut_up(grid, a, b, c);
    ASSERT_EQ(inside.areas.size(), 1u);
    EXPECT_EQ(inside.areas.begin()->first, grid.index(2, 2, 2));
    b[(axis + 1) % 3] = 1.9;  // and where such a face is cut
    EXPECT_EQ(cut_up(grid, a, b, c).areas.size(), 2u);
    EXPECT_NEAR(sum_of(cut_up(grid, a, b, c)), area(a, b, c), 1e-15);
    c[axis] = -0.5;  // a corner below: only an edge is left on the plane
    EXPECT_EQ(cut_up(grid, a, b, c).areas.count(grid.index(2, 2, 2)), 0u);
  }
}

TEST(VoxelCutter, RangesOfLayersTellTheSameBits) {
  const Subdivision grid(box_of(Vec3(-1), Vec3(1)), 6);
  Dice dice(2);
  for (int n = 0; n < 200; ++n) {
    DVec3 corner[3];
    for (DVec3& p : corner) p = DVec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    const Cut whole = cut_up(grid, corner[0], corner[1], corner[2]);
    Cut parts;
    for (const auto& [first, last] : {std::pair{0u, 1u}, {1u, 4u}, {4u, 6u}}) {
      const Cut cut = cut_up(grid, corner[0], corner[1], corner[2], first, last);
      parts.areas.insert(cut.areas.begin(), cut.areas.end());
      parts.order.insert(parts.order.end(), cut.order.begin(), cut.order.end());
    }
    EXPECT_EQ(parts.order, whole.order);
    EXPECT_EQ(parts.areas, whole.areas);
  }
}

// Needles from end to end, hardly wider than rounding: corners of pieces must stay few, and in their voxels.
TEST(VoxelCutter, SurvivesNeedles) {
  const Subdivision grid(box_of(Vec3(-1e9f), Vec3(1e9f)), 16);
  Dice dice(3);
  for (int n = 0; n < 2000; ++n) {
    DVec3 corner[3];
    for (DVec3& p : corner) p = 1e9 * DVec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    corner[2] = corner[0] + 0.5 * (corner[1] - corner[0]);
    corner[2].x += dice.between(-1e-6f, 1e-6f);
    const double whole = area(corner[0], corner[1], corner[2]);
    EXPECT_NEAR(sum_of(cut_up(grid, corner[0], corner[1], corner[2])), whole, 1e4) << "of 1e18 m2 that the box has";
  }
}

TEST(Polygon, IsCutOnceWhereItLies) {
  const Polygon flat({0, 0, 3}, {2, 0, 3}, {2, 2, 3});
  Polygon below, above;
  cut(flat, 2, 3, below, above);
  EXPECT_EQ(below.count(), 0u) << "in the plane: above";
  EXPECT_DOUBLE_EQ(above.area(), 2);
  cut(flat, 0, 2, below, above);
  EXPECT_DOUBLE_EQ(below.area(), 2) << "an edge in the plane";
  EXPECT_EQ(above.area(), 0);
  cut(flat, 0, 0, below, above);
  EXPECT_EQ(below.area(), 0);
  EXPECT_DOUBLE_EQ(above.area(), 2);
  cut(flat, 0, 1, below, above);
  EXPECT_EQ(below.count(), 3u);
  EXPECT_DOUBLE_EQ(below.area(), 0.5);
  EXPECT_EQ(above.count(), 4u);
  EXPECT_DOUBLE_EQ(above.area(), 1.5);
}

TEST(Polygon, DrawsPointsEvenly) {
  Polygon house({0, 0, 3}, {2, 0, 3}, {2, 2, 3});
  house.add({1, 3, 3}), house.add({0, 2, 3});
  EXPECT_DOUBLE_EQ(house.area(), 5);
  Dice dice(4);
  const int count = 100000;
  int roof = 0, left = 0;
  for (int n = 0; n < count; ++n) {
    const DVec3 p = house.point(dice.between(0, 5), dice.between(0, 1), dice.between(0, 1));
    EXPECT_EQ(p.z, 3);
    EXPECT_TRUE(p.x >= -1e-12 && p.x <= 2 + 1e-12 && p.y >= -1e-12 && p.y <= 3 - std::fabs(p.x - 1) + 1e-12);
    roof += p.y > 2;
    left += p.x < 0.5;
  }
  // Five standard deviations.
  EXPECT_NEAR(roof, 0.2 * count, 5 * std::sqrt(0.2 * 0.8 * count));
  EXPECT_NEAR(left, 0.225 * count, 5 * std::sqrt(0.225 * 0.775 * count));
}

}  // namespace
}  // namespace espalier
