// Every GLB that is written passes the Khronos validator without an error or a warning.

#include <cstdio>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "derivation/sample.h"
#include "model/expand.h"
#include "shipped_grammar.h"
#include "test_models.h"

namespace espalier {
namespace {

/// What the validator says about a file. Fails the test when it cannot be run.
nlohmann::json validate(const std::string& path) {
  const std::string command = "node '" ESPALIER_SOURCE_DIR "/tests/io/validate_gltf.mjs' '" + path + "' 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  char block[4096];
  while (const std::size_t n = std::fread(block, 1, sizeof block, pipe)) output.append(block, n);
  const int status = ::pclose(pipe);
  const nlohmann::json report = nlohmann::json::parse(output, nullptr, false);
  if (status != 0 || report.is_discarded()) {
    ADD_FAILURE() << "the glTF validator did not run; script/setup installs it and node.\n" << output;
    return {};
  }
  return report;
}

void expect_clean(const Model& model, const ExportOptions& options = {}) {
  const TemporaryFolder folder;
  const std::string path = folder / "model.glb";
  export_model(path, model, primitive_table(), two_materials(), test_provenance(), options);
  const nlohmann::json report = validate(path);
  if (report.is_null()) return;
  EXPECT_EQ(report["numErrors"], 0) << report.dump(1);
  EXPECT_EQ(report["numWarnings"], 0) << report.dump(1);
  // The validator knows neither the instancing extension nor that its accessors are in use, and says so as information.
  if (!options.gpu_instancing) {
    EXPECT_EQ(report["numInfos"], 0) << report.dump(1);
    EXPECT_EQ(report["numHints"], 0) << report.dump(1);
  }
}

TEST(GltfValidator, AcceptsEveryKindOfPlacement) { expect_clean(mixed_model()); }

TEST(GltfValidator, AcceptsAnEmptyModel) { expect_clean({}); }

TEST(GltfValidator, AcceptsInstancing) {
  Model model = mixed_model();
  for (int i = 0; i < 20; ++i) model.instances.push_back(part(MeshKind::box, Vec3(0, 0, i), turn_z(0.6f, 0.8f)));
  expect_clean(model, {.full = true, .gpu_instancing = true});
}

TEST(GltfValidator, AcceptsTinyHugeAndFlatParts) {
  Model model;
  for (const float s : {1e-12f, 1e-5f, 1e5f, 1e12f}) {
    for (const MeshKind kind : kAllKinds) {
      model.instances.push_back(part(kind, Vec3(s), turn_z(0.6f, 0.8f) * scaling(s, s, s)));
      model.instances.push_back(part(kind, Vec3(s), turn_z(0.6f, 0.8f) * scaling(s, 1, 1)));
      model.instances.push_back(part(kind, Vec3(s), scaling(s, 1, 1) * turn_z(0.6f, 0.8f)));
      model.instances.push_back(part(kind, Vec3(s), turn_z(0.6f, 0.8f) * scaling(0, s, s)));
      model.instances.push_back(part(kind, Vec3(s), turn_z(0.6f, 0.8f) * scaling(0, s, 0)));
    }
  }
  expect_clean(model);
}

/// Trees with bark and leaves, their pictures to scale: as the grammar makes them, at the finest and coarsest level.
TEST(GltfValidator, AcceptsTreesAtAllLevels) {
  const auto graph = test::compile_shipped("arboretum.esp", {{"most_spans", "100"}});
  AssimpMeshSource source;
  const MeshTable meshes(*graph, "", source);
  const TemporaryFolder folder;
  const std::string path = folder / "tree.glb";
  for (const std::uint32_t index : {1u, 2u}) {
    RandomStream random({index, Purpose::test, 0, 0});
    Model model;
    Expander(*graph).expand(sample(*graph, random, 10).derivation, ExpandTo::full, model);
    TextureTable textures;
    const Surfaces surfaces(*graph, model, textures);
    std::vector<std::optional<LevelOfDetail>> looks = {std::nullopt};
    for (const std::uint32_t level : {0u, 3u})
      for (const Joints joints : {Joints::separate, Joints::smooth}) looks.push_back(LevelOfDetail{level, joints});
    for (const auto& look : looks) {
      export_model(path, model, meshes, surfaces, test_provenance(), {.detail = look});
      const nlohmann::json report = validate(path);
      if (report.is_null()) return;
      for (const char* kind : {"numErrors", "numWarnings", "numInfos", "numHints"})
        EXPECT_EQ(report[kind], 0) << report.dump(1);
    }
  }
}

TEST(GltfValidator, FindsFaults) {  // else the tests above say nothing
  const TemporaryFolder folder;
  const std::string path = folder / "model.glb";
  export_model(path, mixed_model(), primitive_table(), two_materials(), test_provenance());
  std::string bytes = read_file(path);
  const std::size_t rotation = bytes.find("\"rotation\":[0,");
  ASSERT_NE(rotation, bytes.npos);
  bytes[rotation + 12] = '9';
  write_file(path, bytes);
  const nlohmann::json report = validate(path);
  ASSERT_FALSE(report.is_null());
  EXPECT_GT(report["numErrors"], 0);
}

}  // namespace
}  // namespace espalier
