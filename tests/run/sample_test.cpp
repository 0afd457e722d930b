#include "run/sample.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "derivation/sample.h"
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

/// One sample of three steps in `folder`/ancestor, and a request that goes on from it.
SampleRequest going_on(const TemporaryFolder& folder, std::uint32_t steps) {
  write_text(folder / "bush.esp", R"(grammar bush 1
start Bush
rule Bush { spawn Twig }
rule Twig when depth < 8 {
  k ~ uniform(1, 2)  size k  emit box
  for i in 1..3 { maybe 0.9 spawn Twig }
}
)");
  SampleRequest request = request_in(folder);
  request.grammar = "bush.esp", request.count = 1, request.seed = 4, request.grow = 3;
  AssimpMeshSource source;
  write_samples(request, folder / "ancestor", source, *make_serial_executor(), SampleFiles::genes);
  request.from = "ancestor/01.derivation.json", request.count = 3, request.grow = steps, request.cell = {64, 48};
  return request;
}

/// All of `part` stands in `whole`, in its order.
bool runs_through(const std::vector<std::uint32_t>& part, const std::vector<std::uint32_t>& whole) {
  std::size_t at = 0;
  for (const std::uint32_t draw : whole) at += at < part.size() && part[at] == draw;
  return at == part.size();
}

TEST(SampleRequest, WrittenOutItReadsBackEqual) {
  SampleRequest request;
  request.grammar = "a b.esp", request.count = 5, request.seed = 9, request.grow = 4, request.picture = {32, 16};
  request.attributes = {{"x", "1"}, {"fork", "25deg"}};
  request.from = "old \"one\".derivation.json";
  const SampleRequest again = parse_sample_request(to_toml(request), "s", "");
  EXPECT_EQ(to_toml(again), to_toml(request));
  EXPECT_EQ(again.attributes, request.attributes);
  EXPECT_EQ(again.grow, request.grow);
  EXPECT_EQ(again.from, request.from);
  request.from.clear(), request.grow.reset(), request.genes = 30, request.cell = {80, 60}, request.columns = 4;
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

TEST(Sample, FromGoesOnWithWhatStandsThere) {
  const TemporaryFolder folder;
  SampleRequest request = going_on(folder, 0);
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  const Derivation ancestor = SampleSet(request, source, *executor).derivation(2);  // no step: the ancestor itself
  ASSERT_EQ(ancestor.size(), 4u);
  request.grow = 5;
  const SampleSet grown(request, source, *executor);
  for (std::size_t i = 0; i < grown.size(); ++i) {
    EXPECT_EQ(grown.derivation(i).size(), 9u);
    EXPECT_EQ(grown.derivation(i).detail_seed, ancestor.detail_seed);
    EXPECT_TRUE(runs_through(ancestor.draws, grown.derivation(i).draws));
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(grown.derivation(i) == grown.derivation(k));
  }
  EXPECT_TRUE(grown.warnings().empty());
  request.from.clear(), request.grow = 8;  // of the same seed: all but the first have another ancestor
  const SampleSet others(request, source, *executor);
  EXPECT_TRUE(runs_through(ancestor.draws, others.derivation(0).draws));
  EXPECT_FALSE(runs_through(ancestor.draws, others.derivation(1).draws));
}

TEST(Sample, WhatGoesOnDrawsOtherNumbersThanItsAncestorDid) {
  const TemporaryFolder folder;
  const SampleRequest request = going_on(folder, 6);  // with the seed of the ancestor
  AssimpMeshSource source;
  const Derivation grown = SampleSet(request, source, *make_serial_executor()).derivation(0);
  std::vector<std::uint32_t> draws = grown.draws;
  std::sort(draws.begin(), draws.end());
  EXPECT_EQ(std::adjacent_find(draws.begin(), draws.end()), draws.end());
}

TEST(Sample, WhatGoesOnIsReproducedIdentically) {
  const TemporaryFolder folder;
  const SampleRequest request = going_on(folder, 6);
  sample_into(request, folder / "out");
  std::filesystem::remove_all(folder / "ancestor");
  EXPECT_TRUE(std::filesystem::exists(folder / "out/inputs/start/01.derivation.json"));
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  const ReproduceReport report = reproduce(folder / "out/03.glb", "", source, *executor);
  EXPECT_TRUE(report.identical()) << ::testing::PrintToString(report.differences);
  write_text(folder / "out/inputs/start/01.derivation.json", "{}");
  EXPECT_FALSE(reproduce(folder / "out/03.glb", "", source, *executor).identical());
}

TEST(Sample, FromSaysWhatIsWrong) {
  const TemporaryFolder folder;
  const SampleRequest request = going_on(folder, 6);
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  const auto message = [&](const SampleRequest& bad) -> std::string {
    try {
      SampleSet(bad, source, *executor);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  SampleRequest bad = request;
  bad.grow.reset();
  EXPECT_THAT(message(bad), ::testing::HasSubstr("say how many steps it shall grow"));
  EXPECT_THROW(parse_sample_request(to_toml(bad), "s", ""), Error);
  bad = request, bad.from = "none.derivation.json";
  EXPECT_THAT(message(bad), ::testing::HasSubstr("none.derivation.json: cannot read"));
  write_pile(folder);
  bad = request, bad.grammar = "pile.esp";
  EXPECT_THAT(message(bad), ::testing::HasSubstr("01.derivation.json: derivation: grammar: made by \"bush\""));
}

TEST(Sample, FromWhatIsFinishedIsTold) {
  const TemporaryFolder folder;
  SampleRequest request = going_on(folder, 20'000);  // more than a bush of eight levels can take
  request.count = 1;
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  write_samples(request, folder / "whole", source, *executor, SampleFiles::genes);
  request.from = "whole/01.derivation.json", request.grow = 1;
  const SampleSet samples(request, source, *executor);
  ASSERT_TRUE(is_finished(samples.derivation(0)));
  EXPECT_THAT(samples.warnings(), ::testing::ElementsAre(::testing::HasSubstr("is finished")));
}

TEST(Sample, OnlyGenesAreTheSameGenes) {
  const TemporaryFolder folder;
  write_pile(folder);
  SampleRequest request = request_in(folder);
  request.cell = {64, 48};
  AssimpMeshSource source;
  write_samples(request, folder / "genes", source, *make_serial_executor(), SampleFiles::genes);
  sample_into(request, folder / "all");
  auto genes = read_tree(folder / "genes"), all = read_tree(folder / "all");
  EXPECT_EQ(genes.size(), 5u);  // three derivations, samples.toml, the grammar
  for (const auto& [name, bytes] : genes) EXPECT_EQ(bytes, all[name]) << name;
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
