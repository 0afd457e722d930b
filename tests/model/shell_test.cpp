// What of models becomes surface.
#include "model/shell.h"

#include <gtest/gtest.h>

#include "model/parts.h"
#include "model/primitives.h"

namespace espalier {
namespace {

double area_of(const Shell& shell) {
  double sum = 0;
  for_each_triangle(shell, [&](const DVec3& a, const DVec3& b, const DVec3& c) { sum += area(a, b, c); });
  return sum;
}

TEST(Shell, IsAMeshInItsOwnCoordinates) {
  Mesh box = make_primitive(MeshKind::box, 1, 0);
  for (Vec3& p : box.positions) p = Vec3(3, 0, 0) + p * Vec3(1, 2, 3);
  const Shell shell = shell_of(box);
  EXPECT_EQ(triangle_count(shell), 12u);
  EXPECT_DOUBLE_EQ(area_of(shell), 2 * (2 + 3 + 6));
  EXPECT_EQ(bounds(shell).min, Vec3(2.5f, -1, -1.5f));
  EXPECT_EQ(bounds(shell).max, Vec3(3.5f, 1, 1.5f));
}

TEST(Shell, PlacesItsParts) {
  Shell shell = shell_of(make_primitive(MeshKind::box, 1, 0));
  Frame frame;
  frame.basis[1] = Vec3(0, 4, 0);
  frame.basis[0] = Vec3(-1, 0, 0);  // mirrored: areas stay above 0
  frame.origin = Vec3(10, 0, 0);
  shell.parts.push_back({frame, 0});
  EXPECT_EQ(triangle_count(shell), 24u);
  EXPECT_DOUBLE_EQ(area_of(shell), 6 + 2 * (4 + 4 + 1));
  EXPECT_EQ(bounds(shell).max, Vec3(10.5f, 2, 0.5f));
}

TEST(Shell, TrianglesInALineHaveNoArea) {
  EXPECT_TRUE(has_area({0, 0, 0}, {1, 0, 0}, {0, 1e-5, 0}));
  EXPECT_FALSE(has_area({0, 0, 0}, {1, 0, 0}, {0, 1e-6, 0}));
  EXPECT_FALSE(has_area({0, 0, 0}, {1, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(has_area({0.1, 0.2, 0.3}, {1.1, 2.2, 3.3}, {0.1 + 1.0 / 3, 0.2 + 2.0 / 3, 0.3 + 1}));
  EXPECT_TRUE(has_area({0, 0, 0}, {1e-20, 0, 0}, {0, 1e-20, 0}));
  EXPECT_TRUE(has_area({0, 0, 0}, {1e18, 0, 0}, {0, 1e18, 0}));
}

}  // namespace
}  // namespace espalier
