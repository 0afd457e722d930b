#include "model/primitives.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace espalier {
namespace {

constexpr MeshKind kSolids[] = {MeshKind::box,    MeshKind::cylinder, MeshKind::cone,
                                MeshKind::sphere, MeshKind::wedge,    MeshKind::pyramid};
constexpr MeshKind kFlats[] = {MeshKind::quad, MeshKind::leaf};

void expect_normals_fit(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const Vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-6) << mesh.name;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], face = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    EXPECT_GT(glm::length(face), 0) << mesh.name << ": a triangle without area";
    for (const std::uint32_t corner : t) EXPECT_GT(glm::dot(face, mesh.normals[corner]), 0) << mesh.name;
  }
}

TEST(Primitives, SolidsAreClosedAndFaceOutwards) {
  for (const MeshKind kind : kSolids) {
    const Mesh mesh = make_primitive(kind, 0.5f, 32);
    EXPECT_EQ(open_edges(mesh), 0u) << mesh.name;
    EXPECT_GT(volume(mesh), 0) << mesh.name;
    expect_normals_fit(mesh);
  }
}

TEST(Primitives, FillTheUnitBox) {
  for (const MeshKind kind : kSolids) {
    const Mesh mesh = make_primitive(kind, 1, 32);
    EXPECT_EQ(bounds(mesh).min, Vec3(-0.5f)) << mesh.name;
    EXPECT_EQ(bounds(mesh).max, Vec3(0.5f)) << mesh.name;
  }
  for (const MeshKind kind : kFlats) {
    const Mesh mesh = make_primitive(kind, 1, 32);
    EXPECT_EQ(bounds(mesh).min, Vec3(-0.5f, -0.5f, 0)) << mesh.name;
    EXPECT_EQ(bounds(mesh).max, Vec3(0.5f, 0.5f, 0)) << mesh.name;
    expect_normals_fit(mesh);
    EXPECT_EQ(mesh.normals[0], Vec3(0, 0, 1)) << mesh.name;
    EXPECT_GT(open_edges(mesh), 0u) << mesh.name;
  }
}

TEST(Primitives, HaveTheirVolumes) {
  const double pi = std::acos(-1.0);
  EXPECT_DOUBLE_EQ(volume(make_primitive(MeshKind::box, 1, 32)), 1);
  EXPECT_DOUBLE_EQ(volume(make_primitive(MeshKind::wedge, 1, 32)), 0.5);
  EXPECT_NEAR(volume(make_primitive(MeshKind::pyramid, 1, 32)), 1.0 / 3, 1e-7);
  EXPECT_NEAR(volume(make_primitive(MeshKind::cylinder, 1, 200)), pi / 4, 2e-4);
  EXPECT_NEAR(volume(make_primitive(MeshKind::cone, 0, 200)), pi / 12, 2e-4);
  EXPECT_NEAR(volume(make_primitive(MeshKind::cone, 0.5f, 200)), pi / 12 * 1.75, 2e-4);
  EXPECT_NEAR(volume(make_primitive(MeshKind::sphere, 1, 32)), pi / 6, 0.01);
}

TEST(Primitives, WedgeRampsUpTowardsPlusZ) {
  for (const Vec3& p : make_primitive(MeshKind::wedge, 1, 3).positions) {
    if (p.y > 0) {
      EXPECT_EQ(p.z, 0.5f);
    }
  }
}

TEST(Primitives, ConeTopIsClampedAtZeroAndMayFlare) {
  EXPECT_EQ(make_primitive(MeshKind::cone, -3, 8).positions, make_primitive(MeshKind::cone, 0, 8).positions);
  EXPECT_EQ(make_primitive(MeshKind::cone, NAN, 8).positions, make_primitive(MeshKind::cone, 0, 8).positions);
  EXPECT_EQ(bounds(make_primitive(MeshKind::cone, 3, 8)).max, Vec3(1.5f, 0.5f, 1.5f));
}

RC_GTEST_PROP(Primitives, AnyConeIsClosedAndFacesOutwards, ()) {
  const auto sides = static_cast<std::uint16_t>(*rc::gen::inRange(0, 300));
  const float top = static_cast<float>(*rc::gen::inRange(0, 300)) / 100;
  const Mesh mesh = make_primitive(MeshKind::cone, top, sides);
  RC_ASSERT(open_edges(mesh) == 0);
  const double n = sides < 3 ? 3 : sides, area = n / 2 * std::sin(2 * std::acos(-1.0) / n) / 4;
  RC_ASSERT(std::abs(volume(mesh) - area * (1 + top + top * top) / 3) < 1e-5);
}

}  // namespace
}  // namespace espalier
