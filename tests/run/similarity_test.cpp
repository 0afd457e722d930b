// Models compared by what their files show: sources, boxes, pairs, JSON and CSV.
#include "run/similarity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/fixtures.h"
#include "run/sample.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using testing::box_obj;
using testing::write_text;

class Similarity : public ::testing::Test {
 protected:
  Similarity() {
    write_text(folder_ / "box.obj", box_obj(0, 0, 0, 1, 2, 3));
    write_text(folder_ / "moved.obj", box_obj(16, 8, 4, 18, 12, 10));  // and twice as large
    write_text(folder_ / "flat.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 4 3 2 1\n");
    write_text(folder_ / "cone.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0.5 2 0.5\n"
                                     "f 1 2 3 4\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n");
  }

  SimilarityRequest request(const std::vector<std::string>& names) {
    SimilarityRequest request;
    for (const std::string& name : names) request.models.push_back(folder_ / name);
    return request;
  }
  SimilarityReport compare(const SimilarityRequest& request) {
    return compare_shapes(request, source_, *make_serial_executor());
  }
  std::string error_of(const SimilarityRequest& request) {
    try {
      compare(request);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  /// Two derivations of the pile, and what they show as files.
  void sample_piles() {
    write_text(folder_ / "pile.esp", testing::kPileGrammar);
    SampleRequest sample;
    sample.grammar = folder_ / "pile.esp";
    sample.count = 2, sample.genes = 12, sample.picture = sample.cell = {64, 48};
    write_samples(sample, folder_ / "piles", source_, *make_serial_executor());
  }

  testing::TemporaryFolder folder_;
  AssimpMeshSource source_;
};

TEST_F(Similarity, PlaceAndSizeCountOnlyInASharedBox) {
  SimilarityRequest both = request({"box.obj", "moved.obj"});
  const SimilarityReport own = compare(both);
  EXPECT_LT(own.pair(0, 1).all.mean, 0.01) << "but for a few points that rounding moves";
  EXPECT_EQ(own.pair(0, 1).both, 56u) << "the surface of 4 x 4 x 4 voxels";
  EXPECT_EQ(own.pair(0, 1).neither, 8u);
  EXPECT_NEAR(own.models[0].area, 22, 1e-5);
  EXPECT_NEAR(own.models[1].area, 88, 1e-5);
  both.shared_box = true;
  const SimilarityReport shared = compare(both);
  EXPECT_EQ(shared.pair(0, 1).both, 0u);
  EXPECT_GT(shared.pair(0, 1).only_first, 0u);
  EXPECT_EQ(shared.pair(0, 1).occupied->min, 1);
}

TEST_F(Similarity, AModelIsNoDistanceFromItselfButForOtherPoints) {
  const SimilarityReport report = compare(request({"cone.obj", "cone.obj"}));
  EXPECT_EQ(report.pair(0, 1).all.max, 0);
  EXPECT_GT(report.models[0].anew.all.mean, 0.02);
  EXPECT_LT(report.models[0].anew.occupied->median, 0.3);
  EXPECT_EQ(report.models[0].anew.all.max, report.models[1].anew.all.max);
}

TEST_F(Similarity, MatricesArePairsByThemselves) {
  const std::vector<std::string> names = {"box.obj", "cone.obj", "flat.obj", "moved.obj"};
  const SimilarityReport all = compare(request(names));
  ASSERT_EQ(all.pairs.size(), 6u);
  EXPECT_TRUE(all.voxels.empty());
  for (std::size_t a = 0; a < names.size(); ++a) {
    for (std::size_t b = 0; b < names.size(); ++b) {
      if (a == b) continue;
      const SimilarityReport alone = compare(request({names[a], names[b]}));
      const ShapeDistance &here = all.pair(a, b), &there = alone.pair(0, 1);
      EXPECT_EQ(here.all.median, there.all.median) << names[a] << names[b];
      EXPECT_EQ(here.all.mean, there.all.mean);
      EXPECT_EQ(here.occupied->upper, there.occupied->upper);
      EXPECT_EQ(a < b ? here.only_first : here.only_second, there.only_first);
    }
  }
  EXPECT_GT(all.pair(0, 1).all.median, all.pair(0, 3).all.median);
}

// Models of one line of growth: the more steps apart, the further apart, and what stays as it is counts nothing.
TEST_F(Similarity, GrowsAsModelsGrowApart) {
  SimilarityRequest chain;
  for (const std::uint32_t steps : {10u, 20u, 40u, 80u}) {
    SampleRequest sample;
    sample.grammar = std::string(ESPALIER_SOURCE_DIR) + "/grammars/guided-tree.esp";
    sample.count = 1, sample.seed = 3, sample.grow = steps, sample.picture = sample.cell = {64, 48};
    const std::string folder = folder_ / ("grown" + std::to_string(steps));
    write_samples(sample, folder, source_, *make_serial_executor());
    chain.models.push_back(folder + "/01.derivation.json");
  }
  chain.shared_box = true;
  const SimilarityReport report = compare(chain);
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b + 1 < 4; ++b) {
      EXPECT_LT(report.pair(a, b).occupied->mean, report.pair(a, b + 1).occupied->mean) << a << " " << b;
      EXPECT_GT(report.pair(a, b + 1).occupied->mean, report.pair(a + 1, b + 1).occupied->mean) << a << " " << b;
    }
  }
  EXPECT_EQ(report.pair(2, 3).occupied->min, 0);
}

TEST_F(Similarity, NamesWhatItComparesByPathOrDerivation) {
  sample_piles();
  SimilarityRequest piles = request({"piles/01.derivation.json", "piles/01.png", "piles/01.glb", "pile.stl",
                                     "piles/02.derivation.json"});
  // Mesh files that Espalier wrote are read as they are.
  export_derivation({piles.models[0], "", {}, folder_ / "pile.stl"}, source_, *make_serial_executor());
  piles.descriptor.pairs = 1000;
  const SimilarityReport report = compare(piles);
  const bool meshes[] = {false, false, true, true, false};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(report.models[i].is_mesh, meshes[i]) << piles.models[i];
    if (i == 4) continue;
    EXPECT_EQ(report.models[i].triangles, report.models[0].triangles);
    EXPECT_NEAR(report.models[i].area / report.models[0].area, 1, 1e-4);
  }
  EXPECT_EQ(report.pair(0, 1).all.max, 0) << "a picture stands for its derivation";
  EXPECT_LT(report.pair(0, 2).occupied->mean, 0.05);
  EXPECT_LT(report.pair(0, 3).occupied->mean, 0.05);
  EXPECT_GT(report.pair(0, 4).occupied->mean, 0.1);
}

TEST_F(Similarity, AttributesReachDerivationsOnly) {
  sample_piles();
  SimilarityRequest wide = request({"piles/01.derivation.json", "box.obj"});
  const double before = compare(wide).models[0].area;
  wide.attributes = {{"widest", "3"}};
  const SimilarityReport report = compare(wide);
  EXPECT_GT(report.models[0].area, before);
  EXPECT_NEAR(report.models[1].area, 22, 1e-5);
  SimilarityRequest meshes = request({"cone.obj", "box.obj"});
  meshes.attributes = {{"widest", "3"}};
  EXPECT_EQ(error_of(meshes), "-D goes with derivations, and all of the models are mesh files");
  meshes.attributes.clear(), meshes.grammar = folder_ / "pile.esp";
  EXPECT_EQ(error_of(meshes), "--grammar goes with derivations, and all of the models are mesh files");
}

TEST_F(Similarity, ModelsThatShowNothingAreEmptyVoxels) {
  write_text(folder_ / "none.esp", "grammar none 1\nstart S\nrule S { bone (0, 0, 0) -> (0, 1, 0) }\n");
  SampleRequest sample;
  sample.grammar = folder_ / "none.esp", sample.count = 1, sample.picture = sample.cell = {64, 48};
  write_samples(sample, folder_ / "none", source_, *make_serial_executor());
  for (const bool shared : {false, true}) {
    SimilarityRequest some = request({"box.obj", "none/01.derivation.json"});
    some.shared_box = shared;
    const SimilarityReport report = compare(some);
    EXPECT_TRUE(report.models[1].box.empty());
    EXPECT_EQ(report.pair(0, 1).only_first, 56u);
    EXPECT_EQ(report.pair(0, 1).occupied->min, 1);
    SimilarityRequest none = request({"none/01.derivation.json", "none/01.derivation.json"});
    none.shared_box = shared;
    const SimilarityReport nothing = compare(none);
    EXPECT_EQ(nothing.pair(0, 1).all.max, 0);
    EXPECT_FALSE(nothing.pair(0, 1).occupied);
    EXPECT_EQ(median(nothing.pair(0, 1), VoxelChoice::occupied), 0);
    const auto json = nlohmann::json::parse(similarity_json(none, nothing));
    EXPECT_TRUE(json["pairs"][0]["occupied"].is_null());
    EXPECT_TRUE(json["models"][0]["box"].is_null());
  }
}

TEST_F(Similarity, TheSameBytesForAnyNumberOfThreads) {
  for (const bool shared : {false, true}) {
    SimilarityRequest some = request({"box.obj", "cone.obj", "flat.obj"});
    some.shared_box = shared;
    const std::string one = similarity_json(some, compare(some));
    EXPECT_EQ(similarity_json(some, compare_shapes(some, source_, *make_thread_executor(2))), one);
    EXPECT_EQ(similarity_json(some, compare_shapes(some, source_, *make_thread_executor(3))), one);
  }
}

TEST_F(Similarity, JsonHoldsSettingsModelsAndPairs) {
  SimilarityRequest two = request({"box.obj", "cone.obj"});
  two.descriptor.layers = 2, two.descriptor.range = 1.5, two.descriptor.seed = 9;
  const SimilarityReport report = compare(two);
  const auto json = nlohmann::json::parse(similarity_json(two, report));
  EXPECT_EQ(json["similarity"], 1);
  EXPECT_EQ(json["settings"]["range"], 1.5);
  EXPECT_EQ(json["settings"]["box"], "own");
  EXPECT_EQ(json["settings"]["seed"], 9);
  EXPECT_EQ(json["models"][1]["path"], folder_ / "cone.obj");
  EXPECT_EQ(json["models"][1]["triangles"], 6);
  EXPECT_EQ(json["models"][0]["box"]["max"][2], 3);
  EXPECT_EQ(json["pairs"][0]["all"]["median"], report.pair(0, 1).all.median);
  EXPECT_EQ(json["pairs"][0]["voxels"]["both"], 8);
  EXPECT_EQ(json["distances"].size(), 8u);
}

TEST_F(Similarity, CsvIsAMatrixByPath) {
  const SimilarityReport report = compare(request({"box.obj", "cone.obj", "flat.obj"}));
  std::istringstream csv(similarity_csv(report, VoxelChoice::occupied));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4u);
  const std::string box = folder_ / "box.obj", cone = folder_ / "cone.obj";
  EXPECT_EQ(lines[0], "model," + box + "," + cone + "," + (folder_ / "flat.obj"));
  EXPECT_TRUE(lines[1].starts_with(box + ",0,")) << lines[1];
  EXPECT_TRUE(lines[3].ends_with(",0")) << lines[3];
  const std::string between = lines[2].substr(cone.size() + 1, lines[2].find(',', cone.size() + 1) - cone.size() - 1);
  EXPECT_EQ(std::stod(between), report.pair(1, 0).occupied->median);
  EXPECT_TRUE(lines[1].starts_with(box + ",0," + between + ","));
}

TEST_F(Similarity, SaysWhatIsWrongWithWhichFile) {
  write_text(folder_ / "empty.obj", "");
  write_text(folder_ / "cut.glb", "glTF\x02");
  write_text(folder_ / "text.txt", "hello");
  write_text(folder_ / "nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_text(folder_ / "strange.derivation.json", "{}");
  std::filesystem::create_directory(folder_ / "folder");
  for (const char* name : {"none.obj", "none.derivation.json", "none.png", "none", "empty.obj", "cut.glb", "text.txt",
                           "nan.obj", "strange.derivation.json", "folder"}) {
    EXPECT_THAT(error_of(request({"box.obj", name})), HasSubstr(folder_ / name));
    EXPECT_THAT(error_of(request({name, "box.obj"})), HasSubstr(folder_ / name));
  }
  EXPECT_EQ(error_of(request({"box.obj"})), "similarity compares from 2 to 256 models, got 1");
  EXPECT_EQ(error_of(request(std::vector<std::string>(257, "box.obj"))),
            "similarity compares from 2 to 256 models, got 257");
  try {
    load_shown_model(folder_ / "cone.obj", "", {}, source_, 5);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), (folder_ / "cone.obj") + ": must have at most 5 triangles, got 6");
  }
  EXPECT_EQ(triangle_count(load_shown_model(folder_ / "cone.obj", "", {}, source_, 6).shell), 6u);
  SimilarityRequest coarse = request({"none.obj", "none.obj"});
  coarse.descriptor.layers = 0;
  EXPECT_EQ(error_of(coarse), "grid must be from 1 to 16, got 0") << "before any file is read";
}

}  // namespace
}  // namespace espalier
