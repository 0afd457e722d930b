#include "run/sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/mesh_import.h"
#include "run/fixtures.h"
#include "run/reproduce.h"

namespace espalier {
namespace {

using testing::box_obj;
using testing::read_text;
using testing::read_tree;
using testing::TemporaryFolder;
using testing::write_pile;
using testing::write_text;

SampleRequest request_in(const TemporaryFolder& folder) {
  SampleRequest request;
  request.grammar = "pile.esp";
  request.folder = folder.path();
  request.count = 3;
  request.picture = {64, 48};
  return request;
}

void sample_into(const SampleRequest& request, const std::string& out, int threads = 1) {
  AssimpMeshSource source;
  write_samples(request, out, source, *make_thread_executor(threads));
}

TEST(SampleRequest, WrittenOutItReadsBackEqual) {
  SampleRequest request;
  request.grammar = "a b.esp", request.count = 5, request.seed = 9, request.grow = 4, request.picture = {32, 16};
  request.attributes = {{"x", "1"}, {"fork", "25deg"}};
  const SampleRequest again = parse_sample_request(to_toml(request), "s", "");
  EXPECT_EQ(to_toml(again), to_toml(request));
  EXPECT_EQ(again.attributes, request.attributes);
  EXPECT_EQ(again.grow, request.grow);
  request.grow.reset(), request.genes = 30, request.cell = {80, 60}, request.columns = 4;
  const SampleRequest third = parse_sample_request(to_toml(request), "s", "");
  EXPECT_EQ(to_toml(third), to_toml(request));
  EXPECT_EQ(third.genes, 30u);
  EXPECT_EQ(third.cell, request.cell);
  EXPECT_EQ(third.columns, 4u);
  EXPECT_THROW(parse_sample_request("espalier_sample = 1\ngrammar = \"g\"\ngrow = 1\ngenes = 2", "s", ""), Error);
  EXPECT_THROW(parse_sample_request("espalier_sample = 1\ngrammar = \"g\"\ncount = 0", "s", ""), Error);
  EXPECT_THROW(parse_sample_request("espalier_sample = 1\ngrammar = \"g\"\nfoo = 0", "s", ""), Error);
}

TEST(Sample, WritesModelsPicturesAndASheet) {
  const TemporaryFolder folder;
  write_pile(folder);
  sample_into(request_in(folder), folder / "out");
  std::vector<std::string> names;
  for (const auto& [name, text] : read_tree(folder / "out")) names.push_back(name);
  EXPECT_THAT(names, ::testing::ElementsAre("01.derivation.json", "01.glb", "01.png", "02.derivation.json", "02.glb",
                                            "02.png", "03.derivation.json", "03.glb", "03.png", "inputs/pile.esp",
                                            "samples.png", "samples.toml"));
}

TEST(Sample, SameSeedSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  write_pile(folder);
  SampleRequest request = request_in(folder);
  sample_into(request, folder / "one", 1);
  sample_into(request, folder / "three", 3);
  EXPECT_EQ(read_tree(folder / "one"), read_tree(folder / "three"));
  request.seed = 2;
  sample_into(request, folder / "other");
  EXPECT_NE(read_tree(folder / "one").at("01.derivation.json"), read_tree(folder / "other").at("01.derivation.json"));
}

TEST(Sample, GrowStopsAfterItsSteps) {
  const TemporaryFolder folder;
  write_pile(folder);
  SampleRequest request = request_in(folder);
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  request.grow = 0;
  EXPECT_EQ(SampleSet(request, source, *executor).derivation(0).size(), 1u);
  request.grow = 1;
  EXPECT_EQ(SampleSet(request, source, *executor).derivation(0).size(), 2u);
}

TEST(Sample, GenesGrowsToThatMany) {
  const TemporaryFolder folder;
  write_pile(folder);
  SampleRequest request = request_in(folder);
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  request.genes = 5;
  const SampleSet samples(request, source, *executor);
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_GE(samples.derivation(i).size(), 5u);
  EXPECT_TRUE(samples.warnings().empty());
}

TEST(Sample, TheSheetHasTheColumnsAndCellsAskedFor) {
  const TemporaryFolder folder;
  write_pile(folder);
  SampleRequest request = request_in(folder);
  request.cell = {200, 150}, request.columns = 3;
  sample_into(request, folder / "row");
  request.columns = 1;
  sample_into(request, folder / "column");
  const auto size = [&](const char* name) {  // a PNG's header holds them, most significant byte first
    const std::string text = read_text(folder / name);
    const auto whole = [&](std::size_t at) {
      const auto high = static_cast<unsigned char>(text.at(at)), low = static_cast<unsigned char>(text.at(at + 1));
      return static_cast<unsigned>(high << 8 | low);
    };
    return std::array<unsigned, 2>{whole(18), whole(22)};
  };
  EXPECT_GT(size("row/samples.png")[0], 600u);
  EXPECT_LT(size("row/samples.png")[1], 300u);
  EXPECT_LT(size("column/samples.png")[0], 300u);
  EXPECT_GT(size("column/samples.png")[1], 450u);
}

TEST(Sample, SaysWhichModelsAreNotWhole) {
  const TemporaryFolder folder;
  write_pile(folder);
  testing::write_text(folder / "endless.esp", R"(grammar endless 1
start S
rule S { few ~ chance(0.5)  emit box  if few { emit box } else { detail D } }
detail D { for i in 0..9999 { for k in 0..9999 { if k < 0 { emit box } } } }
)");
  SampleRequest request = request_in(folder);
  request.grammar = "endless.esp", request.count = 6;
  AssimpMeshSource source;
  const auto warnings = write_samples(request, folder / "out", source, *make_serial_executor());
  EXPECT_TRUE(!warnings.empty() && warnings.size() < 6) << warnings.size();
  for (const std::string& warning : warnings) EXPECT_THAT(warning, ::testing::HasSubstr("is truncated"));
  request.grammar = "pile.esp";
  EXPECT_TRUE(write_samples(request, folder / "whole", source, *make_serial_executor()).empty());
}

TEST(Sample, AttributesShapeTheModels) {
  const TemporaryFolder folder;
  write_pile(folder);
  SampleRequest request = request_in(folder);
  sample_into(request, folder / "narrow");
  request.attributes["widest"] = "3";
  sample_into(request, folder / "wide");
  EXPECT_NE(read_tree(folder / "narrow").at("01.glb"), read_tree(folder / "wide").at("01.glb"));
  request.attributes["widets"] = "3";
  EXPECT_THROW(sample_into(request, folder / "bad"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "bad"));
}

TEST(Sample, ImportedGrammarsAndTheirMeshesGoAlong) {
  const TemporaryFolder folder;
  write_text(folder / "pile.esp", "grammar pile 1\nimport \"parts/top.esp\"\nstart S\nrule S { spawn Top }\n");
  write_text(folder / "parts/top.esp",
             "grammar top 1\nmesh tower = \"../meshes/tower.obj\"\nstart Top\n"
             "rule Top { wide ~ uniform(1, 2)  size wide  emit tower }\n");
  write_text(folder / "meshes/tower.obj", box_obj(-1, 0, -0.5, 1, 4, 0.5));
  sample_into(request_in(folder), folder / "out");
  std::filesystem::remove_all(folder / "parts");
  std::filesystem::remove_all(folder / "meshes");
  EXPECT_TRUE(std::filesystem::exists(folder / "out/inputs/parts/top.esp"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/inputs/meshes/tower.obj"));
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  const ReproduceReport report = reproduce(folder / "out/01.glb", "", source, *executor);
  EXPECT_TRUE(report.identical()) << ::testing::PrintToString(report.differences);
}

TEST(Sample, EveryFileIsReproducedIdentically) {
  const TemporaryFolder folder;
  write_pile(folder);
  SampleRequest request = request_in(folder);
  request.grow = 3;
  sample_into(request, folder / "out");
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  for (const char* name : {"01.glb", "02.png", "03.derivation.json", "samples.png"}) {
    const ReproduceReport report = reproduce(folder / "out/" + name, "", source, *executor);
    EXPECT_TRUE(report.identical()) << name << ": " << ::testing::PrintToString(report.differences);
  }
}

}  // namespace
}  // namespace espalier
