#include "render/crease.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "model/primitives.h"

namespace espalier {
namespace {

TEST(Crease, SmoothsCurvedShapes) {
  Mesh sphere = make_primitive(MeshKind::sphere, 1, 32);
  sphere.normals.clear();
  const Mesh smooth = with_crease_normals(sphere);
  EXPECT_EQ(smooth.triangles.size(), sphere.triangles.size());
  for (std::size_t i = 0; i < smooth.positions.size(); ++i) {
    EXPECT_GT(glm::dot(smooth.normals[i], glm::normalize(smooth.positions[i])), 0.99f);
  }
}

TEST(Crease, KeepsEdges) {
  Mesh box = make_primitive(MeshKind::box, 1, 3);
  box.normals.clear();
  const Mesh edged = with_crease_normals(box);
  for (std::size_t i = 0; i < edged.triangles.size(); ++i) {
    for (const std::uint32_t corner : edged.triangles[i]) {
      const Vec3 n = edged.normals[corner];
      EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);
      EXPECT_EQ(n, edged.normals[edged.triangles[i][0]]);
    }
  }
}

TEST(Crease, DropsTrianglesWithoutArea) {
  Mesh mesh = make_primitive(MeshKind::quad, 1, 3);
  mesh.triangles.push_back({0, 0, 1});
  EXPECT_EQ(with_crease_normals(mesh).triangles.size(), 2u);
  EXPECT_TRUE(with_crease_normals(Mesh{}).triangles.empty());
}

}  // namespace
}  // namespace espalier
