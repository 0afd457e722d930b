#include "model/uv.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "model/parts.h"
#include "model/primitives.h"

namespace espalier {
namespace {

constexpr MeshKind kKinds[] = {MeshKind::box,   MeshKind::cylinder, MeshKind::cone, MeshKind::sphere,
                               MeshKind::wedge, MeshKind::pyramid,  MeshKind::quad, MeshKind::leaf};

float area(const Mesh& mesh, const Triangle& t) {
  const Vec2 a = mesh.uvs[t[1]] - mesh.uvs[t[0]], b = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  return 0.5f * (a.x * b.y - a.y * b.x);
}

/// Finite, in range, and every triangle shows some of the picture, not mirrored.
void expect_sound(const Mesh& mesh) {
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size()) << mesh.name;
  for (const Vec2& uv : mesh.uvs) {
    EXPECT_GE(std::min(uv.x, uv.y), -1e-6f) << mesh.name;
    EXPECT_LE(std::max(uv.x, uv.y), 1 + 1e-6f) << mesh.name;
  }
  for (const Triangle& t : mesh.triangles) EXPECT_GT(area(mesh, t), 1e-7f) << mesh.name;
}

TEST(Uv, PrimitivesShowPicturesTheRightWayRound) {
  for (const MeshKind kind : kKinds) {
    for (const float top : {0.0f, 0.5f, 2.0f}) expect_sound(make_primitive(kind, top, 12));
  }
}

TEST(Uv, PicturesStandUprightOnSides) {
  for (const MeshKind kind : kKinds) {
    const Mesh mesh = make_primitive(kind, 0.5f, 12);
    for (const Triangle& t : mesh.triangles) {
      const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
      const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
      if (std::abs(n.y) > 0.8f) continue;  // caps
      const float slack = kind == MeshKind::sphere ? 0.11f : 1e-5f;  // rings are evenly spaced by angle
      for (const std::uint32_t corner : t)
        EXPECT_NEAR(mesh.uvs[corner].y, mesh.positions[corner].y + 0.5f, slack);
    }
  }
}

TEST(Uv, BoxFacesHaveTheWholePicture) {
  float sum = 0;
  const Mesh box = make_primitive(MeshKind::box, 1, 3);
  for (const Triangle& t : box.triangles) sum += area(box, t);
  EXPECT_FLOAT_EQ(sum, 6);
}

TEST(Uv, MeshesWithoutAreMappedFromTheirBox) {
  for (const MeshKind kind : kKinds) {
    Mesh bare = make_primitive(kind, 0.5f, 12);
    bare.uvs.clear();
    for (Vec3& p : bare.positions) p = 30.0f * p + Vec3(5, 6, 7);
    const Mesh mapped = with_uvs(bare);
    EXPECT_EQ(mapped.triangles.size(), bare.triangles.size());
    EXPECT_EQ(mapped.normals.size(), mapped.positions.size());
    expect_sound(mapped);
    for (std::size_t i = 0; i < mapped.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(mapped.positions[mapped.triangles[i][k]], bare.positions[bare.triangles[i][k]]);
    }
  }
}

TEST(Uv, SurviveWhatIsDoneToParts) {
  Mesh flat = make_primitive(MeshKind::sphere, 1, 12);
  flat.normals.clear();
  expect_sound(with_normals(flat));
  Shape shape{make_primitive(MeshKind::cylinder, 1, 12), {}, false};
  const Mesh mirrored = baked(shape, {Mat3(Vec3(-2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)), Vec3(1)});
  EXPECT_EQ(mirrored.uvs.size(), mirrored.positions.size());
  for (std::size_t i = 0; i < mirrored.positions.size(); ++i) EXPECT_TRUE(std::isfinite(mirrored.uvs[i].x));
}

}  // namespace
}  // namespace espalier
