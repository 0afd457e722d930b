// Levels of detail: one model, ever fewer triangles, the same leaves, closed wood, pictures to scale.

#include "model/level_of_detail.h"

#include <cmath>
#include <set>

#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/math.h"
#include "model/primitives.h"
#include "model/shipped.h"
#include "model/surface_scale.h"
#include "model/surfaces.h"
#include "no_files.h"

namespace espalier {
namespace {

using namespace test;

struct Subject {
  std::shared_ptr<const GeneratorGraph> graph;
  Derivation derivation;
  Model model;
  MeshTable meshes;
  std::vector<Material> materials;

  Subject(const std::string& name, std::size_t genes, std::uint32_t index,
          const std::map<std::string, std::string>& attributes = {})
      : graph(compile_shipped(name, attributes)), derivation(grown(*graph, genes, index)) {
    meshes = meshes_of(*graph);
    Expander(*graph).expand(derivation, ExpandTo::full, model);
    materials = materials_of(*graph, model);
  }
  Parts at(std::uint32_t level, Joints joints) const { return parts_at(model, meshes, materials, {level, joints}); }
};

const char* const kTrees[] = {"arboretum.esp", "gentree-natural.esp", "guided-tree.esp", "plant.esp", "gentree.esp"};

TEST(LevelOfDetail, TrianglesFallToTheirShares) {
  for (const char* name : kTrees) {
    SCOPED_TRACE(name);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const Subject tree(name, 60, i);
      for (const Joints joints : {Joints::separate, Joints::smooth}) {
        const auto finest = static_cast<double>(triangle_count(tree.at(0, joints)));
        ASSERT_GT(finest, 0);
        for (std::uint32_t level = 1; level < LevelOfDetail::kCount; ++level) {
          const auto triangles = static_cast<double>(triangle_count(tree.at(level, joints)));
          // The largest piece stays whatever it has, and slivers are not counted before they are made.
          EXPECT_LE(triangles, LevelOfDetail::kShares[level] * finest + 250) << level;
          EXPECT_GT(triangles, 0);
        }
      }
    }
  }
}

TEST(LevelOfDetail, CopiesOfALargeFileAreBounded) {
  class LargeFile : public MeshSource {
   public:
    Mesh load(const std::string&) override {
      Mesh mesh;
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
      mesh.triangles.assign(100'000, {0, 1, 2});
      return mesh;
    }
  } files;
  GeneratorGraph graph;
  graph.meshes.emplace_back().kind = MeshKind::file;
  const MeshTable meshes(graph, "", files);
  Model model;
  model.instances.resize(201);
  try {
    parts_at(model, meshes, {}, {0, Joints::separate});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "level of detail 0 must have at most 20000000 triangles, got 20100000");
  }
}

/// What is counted without meshes is what meshes have, but for slivers.
TEST(LevelOfDetail, TrianglesAreCountedBeforeTheyAreMade) {
  for (const char* name : kTrees) {
    SCOPED_TRACE(name);
    const Subject tree(name, 60, 1);
    for (const Joints joints : {Joints::separate, Joints::smooth}) {
      for (std::uint32_t level = 0; level < LevelOfDetail::kCount; ++level) {
        const std::uint64_t made = triangle_count(tree.at(level, joints));
        const std::uint64_t most = most_triangles_at(tree.model, tree.meshes, tree.materials, {level, joints});
        EXPECT_GE(most, made) << level;
        EXPECT_LE(most, made + made / 200 + 2) << level;
      }
    }
  }
}

/// Shares are reached, not undercut by much: of a tree with leaves and wood enough.
TEST(LevelOfDetail, SharesAreUsed) {
  const Subject tree("gentree-natural.esp", 1, 6);
  for (const Joints joints : {Joints::separate, Joints::smooth}) {
    const auto finest = static_cast<double>(triangle_count(tree.at(0, joints)));
    ASSERT_GT(finest, 20'000);
    for (std::uint32_t level = 1; level < LevelOfDetail::kCount; ++level)
      EXPECT_GT(static_cast<double>(triangle_count(tree.at(level, joints))),
                0.6 * LevelOfDetail::kShares[level] * finest);
  }
}

TEST(LevelOfDetail, WoodIsClosedAndNormalsAreUnit) {
  for (const char* name : kTrees) {
    SCOPED_TRACE(name);
    const Subject tree(name, 40, 2);
    for (std::uint32_t level = 0; level < LevelOfDetail::kCount; ++level) {
      for (const Joints joints : {Joints::separate, Joints::smooth}) {
        for (const Shape& shape : tree.at(level, joints).shapes) {
          if (!shape.open) {
            EXPECT_EQ(open_edges(shape.mesh), 0u);
            EXPECT_GT(volume(shape.mesh), 0);
          }
          ASSERT_EQ(shape.mesh.normals.size(), shape.mesh.positions.size());
          for (const Vec3& n : shape.mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-4);
        }
      }
    }
  }
}

bool equal(const Parts& a, const Parts& b) {
  if (a.shapes.size() != b.shapes.size() || a.parts.size() != b.parts.size()) return false;
  for (std::size_t k = 0; k < a.shapes.size(); ++k) {
    const Mesh &x = a.shapes[k].mesh, &y = b.shapes[k].mesh;
    if (x.positions != y.positions || x.normals != y.normals) return false;
    if (x.uvs != y.uvs || x.triangles != y.triangles) return false;
  }
  return true;
}

TEST(LevelOfDetail, EqualModelsGiveEqualMeshes) {
  const Subject one("arboretum.esp", 1, 5), two("arboretum.esp", 1, 5), other("arboretum.esp", 1, 6);
  for (const std::uint32_t level : {0u, 2u}) {
    EXPECT_TRUE(equal(one.at(level, Joints::smooth), two.at(level, Joints::smooth)));
    EXPECT_FALSE(equal(one.at(level, Joints::smooth), other.at(level, Joints::smooth)));
  }
}

/// One part per material and openness, in model space.
TEST(LevelOfDetail, IsOneMeshPerMaterial) {
  const Subject tree("gentree-natural.esp", 1, 3);
  const Parts parts = tree.at(0, Joints::smooth);
  std::set<std::pair<std::uint16_t, bool>> seen;
  for (const Part& part : parts.parts) {
    EXPECT_TRUE(seen.emplace(part.material, parts.shapes[part.shape].open).second);
    EXPECT_EQ(part.model_from_shape.basis, Mat3(1));
    EXPECT_EQ(part.model_from_shape.origin, Vec3(0));
  }
  EXPECT_LT(parts.parts.size(), 40u);
}

// --- A model by hand: leaves in a row, and a box of a rule.

struct Row {
  Model model;
  MeshTable meshes;
  std::vector<Material> materials{1};

  explicit Row(int leaves) {
    GeneratorGraph graph;
    for (const MeshKind kind : {MeshKind::leaf, MeshKind::box, MeshKind::sphere}) {
      graph.meshes.emplace_back().kind = kind;
    }
    meshes = meshes_of(graph);
    for (int k = 0; k < leaves; ++k) {
      Instance& leaf = model.instances.emplace_back();
      leaf.model_from_mesh.origin = {static_cast<float>(2 * k), 0, 0};
      leaf.layer = Layer::detail;
    }
  }
  Mesh mesh(std::uint32_t level) const {
    const Parts parts = parts_at(model, meshes, materials, {level, Joints::separate});
    return parts.shapes.empty() ? Mesh{} : parts.shapes[0].mesh;
  }
  /// Where the stems of the leaves stand that are left, and how large they are.
  std::map<int, float> stems(std::uint32_t level) const {
    const Mesh all = mesh(level);
    std::map<int, Bounds> boxes;
    std::map<int, float> out;
    for (const Triangle& t : all.triangles) {
      Bounds box;
      for (const std::uint32_t corner : t) box.add(all.positions[corner]);
      // A stem is the lowest corner, and the leaf stands over it.
      for (const std::uint32_t corner : t) {
        const Vec3& p = all.positions[corner];
        if (p.y == -0.5f) out[static_cast<int>(std::lround(p.x / 2))] = 0;
      }
    }
    for (auto& [stem, tall] : out) {
      for (const Vec3& p : all.positions)
        if (std::abs(p.x - 2 * static_cast<float>(stem)) < 1e-4f) tall = std::max(tall, p.y + 0.5f);
    }
    return out;
  }
};

TEST(LevelOfDetail, LeavesLoseCornersThenNumberAndGrow) {
  const Row row(1000);
  EXPECT_EQ(row.mesh(0).triangles.size(), 10'000u);
  EXPECT_EQ(row.mesh(1).triangles.size(), 4'000u) << "all of them, with six corners";
  EXPECT_EQ(row.mesh(2).triangles.size(), 1'500u) << "three quarters, with four";
  EXPECT_EQ(row.mesh(3).triangles.size(), 500u) << "a quarter";
  const auto all = row.stems(1), many = row.stems(2), few = row.stems(3);
  EXPECT_EQ(all.size(), 1000u);
  EXPECT_EQ(many.size(), 750u);
  EXPECT_EQ(few.size(), 250u);
  for (const auto& [stem, tall] : few) {
    EXPECT_TRUE(many.contains(stem)) << "coarser levels keep what finer ones have";
    EXPECT_NEAR(tall, 2, 1e-4) << "a quarter of them, twice as long, cover as much";
  }
  for (const auto& [stem, tall] : many) EXPECT_NEAR(tall, std::sqrt(4.0 / 3), 1e-4);
  // Chosen without a pattern: about as many on either half.
  EXPECT_NEAR(static_cast<double>(std::distance(few.begin(), few.lower_bound(500))), 125, 30);
}

TEST(LevelOfDetail, PartsOfRulesThatAreNotRoundStay) {
  Row row(0);
  for (int k = 0; k < 50; ++k) {
    Instance& box = row.model.instances.emplace_back();
    box.mesh = 1, box.model_from_mesh.origin = {static_cast<float>(2 * k), 0, 0};
  }
  for (std::uint32_t level = 0; level < 4; ++level) EXPECT_EQ(row.mesh(level).triangles.size(), 600u);
  for (Instance& box : row.model.instances) box.layer = Layer::detail;
  EXPECT_EQ(row.mesh(0).triangles.size(), 600u);
  EXPECT_EQ(row.mesh(2).triangles.size(), 84u) << "7 of 50 details, the first level with at most 90 triangles";
}

TEST(LevelOfDetail, RoundPartsHaveSidesByGirth) {
  Row row(0);
  std::size_t before = 0;
  for (const float radius : {0.02f, 0.2f, 2.0f}) {
    row.model.instances.assign(2, {});
    for (Instance& sphere : row.model.instances) sphere.mesh = 2, sphere.model_from_mesh.basis = Mat3(radius);
    row.model.instances[1].model_from_mesh.origin = {10, 0, 0};
    const std::size_t now = row.mesh(0).triangles.size();
    EXPECT_GT(now, before) << radius;
    before = now;
  }
}

TEST(LevelOfDetail, OfNothingIsNothing) {
  const Row row(0);
  for (std::uint32_t level = 0; level < 4; ++level)
    for (const Joints joints : {Joints::separate, Joints::smooth})
      EXPECT_EQ(triangle_count(parts_at({}, row.meshes, {}, {level, joints})), 0u);
}

// --- Pictures to scale.

/// Metres of surface per unit of uv, of a triangle: along u and along v.
Vec2 metres_per_unit(const Mesh& mesh, const Triangle& t, const Vec3& size) {
  const Vec3 a = mesh.positions[t[0]] * size;
  const Vec3 ab = mesh.positions[t[1]] * size - a, ac = mesh.positions[t[2]] * size - a;
  const Vec2 u = mesh.uvs[t[1]] - mesh.uvs[t[0]], v = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const float area = u.x * v.y - u.y * v.x;
  return {glm::length((ab * v.y - ac * u.y) / area), glm::length((ac * u.x - ab * v.x) / area)};
}

TEST(SurfaceScale, BoxesHavePicturesOfOneSize) {
  const Vec3 size(2, 0.5f, 3);
  for (const MeshKind kind : {MeshKind::box, MeshKind::quad}) {
    Mesh mesh = make_primitive(kind, 1, 8);
    scale_uvs(mesh, kind, 1, size, 0.4f);
    for (const Triangle& t : mesh.triangles) {
      const Vec2 metres = metres_per_unit(mesh, t, size);
      EXPECT_NEAR(metres.x, 0.4, 1e-5);
      EXPECT_NEAR(metres.y, 0.4, 1e-5);
    }
  }
}

TEST(SurfaceScale, ConesHaveWholePicturesAroundAndTheirLengthUp) {
  for (const float width : {0.05f, 0.4f, 2.0f}) {
    const Vec3 size(width, 1.5f, width);
    Mesh mesh = make_primitive(MeshKind::cone, 0.6f, 64);
    scale_uvs(mesh, MeshKind::cone, 0.6f, size, 0.3f);
    const double girth = kPi * static_cast<double>(width) * 0.8;
    for (const Triangle& t : mesh.triangles) {
      if (std::abs(mesh.normals[t[0]].y) == 1) continue;
      EXPECT_NEAR(metres_per_unit(mesh, t, size).y, 0.3, 0.003) << "the slant of 64 sides";
    }
    EXPECT_EQ(mesh.uvs[0].x, std::max(1.0, std::round(girth / 0.3)));
  }
}

TEST(SurfaceScale, SizesAreRoundedByFivePerCentAtMost) {
  for (float length = 1e-4f; length < 1e4f; length *= 1.037f) {
    const Vec3 rounded = PartSize(Mat3(Vec3(length, 0, 0), Vec3(0, 2 * length, 0), Vec3(0))).metres();
    EXPECT_NEAR(rounded.x / length, 1, 0.046);
    EXPECT_NEAR(rounded.y / length, 2, 0.092);
    EXPECT_EQ(rounded.z, 0);
  }
}

/// Separate parts: bark is as coarse on twigs as on the trunk, within the rounding of sizes.
TEST(SurfaceScale, BarkOfTheArboretumHasOneScale) {
  const Subject tree("arboretum.esp", 1, 4);
  const Parts parts = collect_parts(tree.model, tree.meshes, true, tree.materials);
  std::size_t seen = 0;
  for (const Part& part : parts.parts) {
    const Material& material = tree.materials[part.material];
    const Mesh& mesh = parts.shapes[part.shape].mesh;
    if (!(material.metres > 0) || mesh.name != "cone") continue;
    const Mat3& basis = part.model_from_shape.basis;
    const Vec3 size(glm::length(basis[0]), glm::length(basis[1]), glm::length(basis[2]));
    for (const Triangle& t : mesh.triangles) {
      if (std::abs(mesh.normals[t[0]].y) == 1) continue;
      EXPECT_NEAR(metres_per_unit(mesh, t, size).y / material.metres, 1, 0.07);
    }
    ++seen;
  }
  EXPECT_GT(seen, 500u);
  EXPECT_LT(parts.shapes.size(), parts.parts.size() / 2) << "and parts of nearly one size share a shape";
}

}  // namespace
}  // namespace espalier
