#include "model/mesh.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "model/model.h"
#include "model/primitives.h"

namespace espalier {
namespace {

TEST(Mesh, OpenEdgesCountsAHole) {
  Mesh box = make_primitive(MeshKind::box, 1, 4);
  ASSERT_EQ(open_edges(box), 0u);
  box.triangles.pop_back();
  EXPECT_EQ(open_edges(box), 3u);
}

TEST(Mesh, OpenEdgesSeesAFlippedTriangle) {
  Mesh box = make_primitive(MeshKind::box, 1, 4);
  std::swap(box.triangles[5][0], box.triangles[5][1]);
  EXPECT_EQ(open_edges(box), 3u);
}

TEST(Mesh, OpenEdgesWeldsMinusZero) {
  Mesh two;  // a tetrahedron whose corners are stored per face, one of them with -0
  const Vec3 o(0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), minus(-0.0f, -0.0f, -0.0f);
  two.positions = {o, y, x, o, x, z, minus, z, y, x, y, z};
  two.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
  EXPECT_EQ(open_edges(two), 0u);
  EXPECT_NEAR(volume(two), 1.0 / 6, 1e-12);
}

TEST(Mesh, VolumeIsNegativeInsideOut) {
  Mesh box = make_primitive(MeshKind::box, 1, 4);
  for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
  EXPECT_DOUBLE_EQ(volume(box), -1);
}

TEST(Mesh, FitToUnitBoxMeetsItExactly) {
  Mesh mesh = make_primitive(MeshKind::sphere, 1, 32);
  for (Vec3& p : mesh.positions) p = p * Vec3(0.3f, 70, 1e-3f) + Vec3(7.1f, -3, 0.01f);
  fit_to_unit_box(mesh);
  EXPECT_EQ(bounds(mesh).min, Vec3(-0.5f));
  EXPECT_EQ(bounds(mesh).max, Vec3(0.5f));
}

TEST(Mesh, FitToUnitBoxTurnsNormalsWithTheSurface) {
  Mesh mesh = make_primitive(MeshKind::wedge, 1, 4);
  for (Vec3& p : mesh.positions) p *= Vec3(1, 4, 1);
  mesh.normals.clear();
  const Mesh reference = make_primitive(MeshKind::wedge, 1, 4);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.normals.push_back(glm::normalize(reference.normals[i] * Vec3(1, 0.25f, 1)));
  }
  fit_to_unit_box(mesh);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    EXPECT_NEAR(glm::distance(mesh.normals[i], reference.normals[i]), 0, 1e-6);
  }
}

TEST(Mesh, FitToUnitBoxKeepsFlatAxesFlat) {
  Mesh mesh = make_primitive(MeshKind::quad, 1, 4);
  for (Vec3& p : mesh.positions) p = Vec3(3 * p.x, 2 * p.y, 5 + 1e-7f * p.x);
  fit_to_unit_box(mesh);
  EXPECT_EQ(bounds(mesh).min, Vec3(-0.5f, -0.5f, 0));
  EXPECT_EQ(bounds(mesh).max, Vec3(0.5f, 0.5f, 0));
  Mesh point;
  point.positions = {Vec3(4, 5, 6)};
  fit_to_unit_box(point);
  EXPECT_EQ(point.positions[0], Vec3(0));
}

class FakeSource final : public MeshSource {
 public:
  Mesh load(const std::string& path) override {
    asked.push_back(path);
    Mesh mesh = make_primitive(MeshKind::box, 1, 4);
    for (Vec3& p : mesh.positions) p = 4.0f * p + Vec3(10, 0, 0);
    return mesh;
  }
  std::vector<std::string> asked;
};

GeneratorGraph three_meshes() {
  GeneratorGraph graph;
  graph.meshes.resize(3);
  graph.meshes[0].kind = MeshKind::cone;
  graph.meshes[1].kind = graph.meshes[2].kind = MeshKind::file;
  graph.meshes[1].path = graph.meshes[2].path = "parts/a.obj";
  graph.meshes[2].as_is = true;
  return graph;
}

TEST(MeshTable, LoadsAndFitsFiles) {
  FakeSource source;
  const MeshTable table(three_meshes(), "house", source);
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(source.asked, (std::vector<std::string>{"house/parts/a.obj", "house/parts/a.obj"}));
  EXPECT_EQ(table.mesh_bounds(1).max, Vec3(0.5f));
  EXPECT_EQ(table.mesh_bounds(2).max, Vec3(12, 2, 2));
  EXPECT_EQ(table.ref(0).kind, MeshKind::cone);
  EXPECT_NEAR(volume(table.mesh(0)), 0.78, 0.01);
}

TEST(ModelBounds, ShowsTheLayersAskedFor) {
  FakeSource source;
  const MeshTable table(three_meshes(), "", source);
  Model model;
  EXPECT_TRUE(bounds(model, table, true).empty());
  Instance rule, proxy, detail;
  rule.mesh = proxy.mesh = detail.mesh = 1;
  proxy.layer = Layer::proxy, proxy.model_from_mesh.origin = Vec3(0, 5, 0);
  detail.layer = Layer::detail, detail.model_from_mesh.origin = Vec3(0, 0, 9);
  model.instances = {rule, proxy, detail};
  EXPECT_EQ(bounds(model, table, true).max, Vec3(0.5f, 0.5f, 9.5f));
  EXPECT_EQ(bounds(model, table, false).max, Vec3(0.5f, 5.5f, 0.5f));
}

TEST(ModelBounds, HoldsFlaringCones) {
  FakeSource source;
  const MeshTable table(three_meshes(), "", source);
  Model model;
  model.instances.emplace_back().top = 3;
  EXPECT_EQ(bounds(model, table, true).max, Vec3(1.5f, 0.5f, 1.5f));
}

}  // namespace
}  // namespace espalier
