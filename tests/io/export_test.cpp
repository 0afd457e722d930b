// Assimp, a second opinion, reads back what is written: parts, faces, box and volume must agree with the model.

#include "io/export.h"

#include <csignal>
#include <sys/resource.h>

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "io/file.h"
#include "io/glb_container.h"
#include "model/parts.h"
#include "test_models.h"

namespace espalier {
namespace {

/// All parts in one mesh: what a flattened file must hold.
Mesh flattened(const Model& model) {
  const Parts parts = collect_parts(model, primitive_table(), true);
  Mesh all;
  for (const Part& part : parts.parts) {
    const Mesh mesh = baked(parts.shapes[part.shape], part.model_from_shape);
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const Triangle& t : mesh.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return all;
}

/// What there is to know of a sum of parts without trusting the code under test: volumes of primitives scale by the
/// determinant.
double expected_volume(const Model& model) {
  const MeshTable table = primitive_table();
  double sum = 0;
  for (const Instance& i : model.instances) {
    const double cone = (1 + i.top + i.top * i.top) / 3;  // of the table's, which has top = 1
    const double shape = volume(table.mesh(i.mesh)) * (table.ref(i.mesh).kind == MeshKind::cone ? cone : 1);
    sum += shape * std::abs(glm::determinant(glm::dmat3(i.model_from_mesh.basis)));
  }
  return sum;
}

class ExportRoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(ExportRoundTrip, KeepsFacesBoxAndVolume) {
  const TemporaryFolder folder;
  const Model model = mixed_model();
  const std::string path = folder / GetParam();
  export_model(path, model, primitive_table(), two_materials(), test_provenance());
  AssimpMeshSource source;
  const Mesh mesh = source.load(path);
  const Mesh expected = flattened(model);
  EXPECT_EQ(mesh.triangles.size(), expected.triangles.size());
  EXPECT_NEAR(volume(mesh), expected_volume(model), 1e-3 * expected_volume(model));
  EXPECT_LT(glm::distance(bounds(mesh).min, bounds(expected).min), 1e-4);
  EXPECT_LT(glm::distance(bounds(mesh).max, bounds(expected).max), 1e-4);
  EXPECT_EQ(mesh.source_hash.size(), 32u);
}

TEST_P(ExportRoundTrip, FacesOutwardsInEveryPart) {
  for (const Instance& instance : mixed_model().instances) {
    Model model;
    model.instances = {instance};
    if (instance.mesh >= static_cast<std::uint16_t>(MeshKind::quad)) continue;  // no inside
    const TemporaryFolder folder;
    const std::string path = folder / GetParam();
    export_model(path, model, primitive_table(), two_materials(), test_provenance());
    AssimpMeshSource source;
    const Mesh mesh = source.load(path);
    EXPECT_NEAR(volume(mesh), expected_volume(model), 1e-3 * expected_volume(model)) << instance.gene;
    for (const Triangle& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
      const glm::dvec3 across = glm::cross(b - a, c - a);
      if (mesh.normals.empty()) continue;
      for (const std::uint32_t corner : t)
        EXPECT_GT(glm::dot(across, glm::dvec3(mesh.normals[corner])), 0) << instance.gene;
    }
  }
}

TEST_P(ExportRoundTrip, IsTheSameBytesEachTime) {
  const TemporaryFolder folder;
  const std::string path = folder / GetParam();
  export_model(path, mixed_model(), primitive_table(), two_materials(), test_provenance());
  const std::string first = read_file(path);
  export_model(path, mixed_model(), primitive_table(), two_materials(), test_provenance());
  EXPECT_EQ(read_file(path), first);
}

TEST_P(ExportRoundTrip, LeavesTheOldFileAloneWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::string path = folder / GetParam();
  write_file(path, "old");
  // A limit on file sizes stands in for a full disk: a write fails half way.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string error = error_of(
      [&] { export_model(path, mixed_model(), primitive_table(), two_materials(), test_provenance()); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(error.find(path), error.npos) << error;
  EXPECT_NE(error.find("File too large"), error.npos) << error;
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(folder.file_count(), 1u) << "a temporary file was left behind";
}

TEST_P(ExportRoundTrip, NamesTheFolderThatIsMissing) {
  const std::string path = std::string("/nowhere/at/all/") + GetParam();
  const std::string error = error_of([&] { export_model(path, {}, primitive_table(), {}, {}); });
  EXPECT_EQ(error, path + ": cannot write: No such file or directory");
}

TEST_P(ExportRoundTrip, WritesAnEmptyModel) {
  const TemporaryFolder folder;
  const std::string path = folder / GetParam();
  export_model(path, {}, primitive_table(), two_materials(), test_provenance());
  EXPECT_GT(read_file(path).size(), 0u);
  AssimpMeshSource source;
  EXPECT_NE(error_of([&] { source.load(path); }).find(path), std::string::npos);
}

TEST_P(ExportRoundTrip, LeavesOutFramesThatAreNotFinite) {
  const TemporaryFolder folder;
  const std::string path = folder / GetParam();
  Model model = mixed_model();
  const Mesh expected = flattened(model);
  model.instances.push_back(part(MeshKind::box, Vec3(NAN)));
  model.instances.push_back(part(MeshKind::box, Vec3(0), Mat3(INFINITY)));
  model.instances.push_back(part(MeshKind::box, Vec3(1e30f)));
  export_model(path, model, primitive_table(), two_materials(), test_provenance());
  AssimpMeshSource source;
  EXPECT_EQ(source.load(path).triangles.size(), expected.triangles.size());
}

INSTANTIATE_TEST_SUITE_P(Formats, ExportRoundTrip, testing::Values("a.glb", "a.obj", "a.ply", "a.stl"),
                         [](const auto& format) { return std::string(format.param).substr(2); });

nlohmann::json glb_json(const std::string& path) {
  const std::string bytes = read_file(path);
  return nlohmann::json::parse(find_glb_json(bytes).value());
}

TEST(ExportGlb, SharesMeshesAndGivesEveryPartANode) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.glb";
  Model model;
  for (int i = 0; i < 10; ++i)
    model.instances.push_back(part(MeshKind::box, Vec3(i, 0, 0), scaling(i % 2 ? 1 : -1, 1, 2)));
  model.instances.push_back(part(MeshKind::box, Vec3(0), Mat3(1), 1));
  model.instances.push_back(part(MeshKind::quad, Vec3(0), scaling(1, 1, 0), 0));
  export_model(path, model, primitive_table(), two_materials(), test_provenance());
  const nlohmann::json gltf = glb_json(path);
  EXPECT_EQ(gltf["nodes"].size(), 13u);
  EXPECT_EQ(gltf["nodes"][0]["name"], "spaceship");
  EXPECT_EQ(gltf["nodes"][0]["children"].size(), 12u);
  EXPECT_EQ(gltf["meshes"].size(), 3u);     // box, box of glass, quad
  EXPECT_EQ(gltf["accessors"].size(), 6u);  // of a box and a quad
  EXPECT_EQ(gltf["materials"].size(), 3u);  // hull, glass, hull seen from both sides
  EXPECT_EQ(gltf["materials"][1]["alphaMode"], "BLEND");
  EXPECT_EQ(gltf["materials"][2]["doubleSided"], true);
  EXPECT_EQ(gltf["asset"]["generator"], "Espalier 0.1.0");
}

TEST(ExportGlb, NodesKnowTheirGene) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.glb";
  export_model(path, mixed_model(), primitive_table(), two_materials(), test_provenance());
  const nlohmann::json gltf = glb_json(path);
  ASSERT_EQ(gltf["nodes"].size(), mixed_model().instances.size() + 1);
  for (std::size_t i = 1; i < gltf["nodes"].size(); ++i) EXPECT_EQ(gltf["nodes"][i]["extras"]["gene"], 99 + i);
}

TEST(ExportGlb, BakesOnlyWhatShears) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.glb";
  Model model;
  for (int i = 0; i < 5; ++i) {
    model.instances.push_back(part(MeshKind::sphere, Vec3(i, 0, 0), turn_z(0.6f, 0.8f) * scaling(1, 2, 3)));
  }
  model.instances.push_back(part(MeshKind::sphere, Vec3(9, 0, 0), scaling(1, 2, 3) * turn_z(0.6f, 0.8f)));
  export_model(path, model, primitive_table(), two_materials(), test_provenance());
  EXPECT_EQ(glb_json(path)["meshes"].size(), 2u);
}

TEST(ExportGlb, InstancingIsRequiredWhereUsed) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.glb";
  Model model;
  for (int i = 0; i < 10; ++i) model.instances.push_back(part(MeshKind::box, Vec3(i, 0, 0), turn_z(0.6f, 0.8f)));
  export_model(path, model, primitive_table(), {}, {}, {.full = true, .gpu_instancing = true});
  const nlohmann::json gltf = glb_json(path);
  EXPECT_EQ(gltf["extensionsRequired"], nlohmann::json::array({"EXT_mesh_gpu_instancing"}));
  ASSERT_EQ(gltf["nodes"].size(), 2u);
  const auto& attributes = gltf["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
    const auto& accessor = gltf["accessors"][attributes[name].get<std::size_t>()];
    EXPECT_EQ(accessor["count"], 10) << name;
    EXPECT_EQ(accessor["componentType"], 5126) << name;
  }
  model.instances.resize(1);
  export_model(path, model, primitive_table(), {}, {}, {.full = true, .gpu_instancing = true});
  EXPECT_FALSE(glb_json(path).contains("extensionsRequired"));
}

/// Any turn, as a product of turns about random axes, in single precision.
Mat3 random_turn(RandomStream& random) {
  Mat3 m(1);
  for (int i = 0; i < 40; ++i) {
    const float s = static_cast<float>(2 * random.next_unit() - 1), c = std::sqrt(1 - s * s);
    const Mat3 z = turn_z(s, random.chance(0.5) ? c : -c);
    m = m * Mat3(Vec3(z[0].z, z[0].x, z[0].y), Vec3(z[2].z, z[2].x, z[2].y), Vec3(z[1].z, z[1].x, z[1].y)) * z;
  }
  return m;
}

TEST(ExportGlb, PlacesAnyTurnedPartWhereItBelongs) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.glb";
  AssimpMeshSource source;
  RandomStream random({5, Purpose::test});
  for (int i = 0; i < 30; ++i) {
    Model model;
    const Mat3 mirror = scaling(i % 2 ? -1 : 1, 1, 1);
    model.instances = {part(MeshKind::wedge, Vec3(1, 2, 3), mirror * random_turn(random) * scaling(1, 2, 3))};
    export_model(path, model, primitive_table(), {}, {});
    EXPECT_TRUE(glb_json(path)["nodes"][1].contains("rotation")) << i;
    const Mesh read = source.load(path), expected = flattened(model);
    ASSERT_EQ(read.positions.size(), expected.positions.size());
    EXPECT_NEAR(volume(read), 3, 1e-3) << i;
    for (const Vec3& p : expected.positions) {
      float nearest = INFINITY;
      for (const Vec3& q : read.positions) nearest = std::min(nearest, glm::distance(p, q));
      EXPECT_LT(nearest, 1e-4) << i;
    }
  }
}

TEST(Export, ShowsTheLayersAskedFor) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.stl";
  Model model;
  model.instances = {part(MeshKind::box, {0, 0, 0}), part(MeshKind::box, {5, 0, 0}), part(MeshKind::box, {9, 0, 0})};
  model.instances[1].layer = Layer::proxy;
  model.instances[2].layer = Layer::detail;
  AssimpMeshSource source;
  export_model(path, model, primitive_table(), {}, {});
  EXPECT_EQ(bounds(source.load(path)).max.x, 9.5f);
  export_model(path, model, primitive_table(), {}, {}, {.full = false});
  EXPECT_EQ(bounds(source.load(path)).max.x, 5.5f);
}

TEST(Export, RefusesOtherEndings) {
  for (const char* path : {"model.xyz", "model", "/tmp/", ""}) {
    const std::string error = error_of([&] { export_model(path, {}, primitive_table(), {}, {}); });
    EXPECT_NE(error.find("models are written as .glb, .obj, .ply or .stl"), error.npos) << path << ": " << error;
  }
}

TEST(Export, NamesTheFileWhoseProvenanceIsNotText) {
  Provenance broken = test_provenance();
  broken.engine = "\xff";
  const std::string error = error_of([&] { export_model("/tmp/x.glb", {}, primitive_table(), {}, broken); });
  EXPECT_TRUE(error.starts_with("/tmp/x.glb: provenance: ")) << error;
}

TEST(Export, EndingsMayBeUpperCase) {
  const TemporaryFolder folder;
  export_model(folder / "A.GLB", mixed_model(), primitive_table(), {}, {});
  EXPECT_TRUE(read_file(folder / "A.GLB").starts_with("glTF"));
}

TEST(ExportObj, NamesItsMaterials) {
  const TemporaryFolder folder;
  export_model(folder / "ship.obj", mixed_model(), primitive_table(), two_materials(), test_provenance());
  const std::string obj = read_file(folder / "ship.obj"), mtl = read_file(folder / "ship.mtl");
  EXPECT_NE(obj.find("\nmtllib ship.mtl\n"), obj.npos);
  for (const char* name : {"hull", "glass_pane", "engine"}) {
    EXPECT_NE(obj.find(std::string("\nusemtl ") + name + "\n"), obj.npos) << name;
    EXPECT_NE(mtl.find(std::string("\nnewmtl ") + name + "\n"), mtl.npos) << name;
  }
}

TEST(ExportObj, WritesBothFilesOrNeither) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "ship.mtl");  // so that the library cannot be written
  write_file(folder / "ship.obj", "old");
  const std::string error =
      error_of([&] { export_model(folder / "ship.obj", mixed_model(), primitive_table(), {}, {}); });
  EXPECT_EQ(error, (folder / "ship.mtl") + ": cannot write: Is a directory");
  EXPECT_EQ(read_file(folder / "ship.obj"), "old");
  EXPECT_EQ(folder.file_count(), 2u);
}

/// What is told is what is written: triangles of the STL file, which holds nothing else.
TEST(Export, TellsItsTriangles) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.stl";
  for (std::uint32_t level = 0; level <= LevelOfDetail::kCount; ++level) {
    ExportOptions options;
    if (level < LevelOfDetail::kCount) options.detail = LevelOfDetail{level, Joints::smooth};
    const std::uint64_t triangles =
        export_model(path, mixed_model(), primitive_table(), two_materials(), test_provenance(), options);
    EXPECT_EQ(read_file(path).size(), 84 + 50 * triangles);
  }
}

}  // namespace
}  // namespace espalier
