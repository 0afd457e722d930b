#include "studio/species_pack.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::read_text;
using testing::read_tree;
using testing::TemporaryFolder;

const std::string kGrammar = std::string(ESPALIER_SOURCE_DIR) + "/grammars/gentree.esp";

SpeciesRequest request_for(const std::string& from, std::uint32_t count) {
  SpeciesRequest request;
  request.from = from;
  request.settings.count = count;
  request.most_triangles = 4000;
  request.form.cell = {64, 64};
  return request;
}

TEST(SpeciesPack, WritesModelsAnIndexAndASheetTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  AssimpMeshSource source;
  SpeciesRequest request = request_for(kGrammar, 6);
  request.attributes = {{"leafy", "false"}};
  const SpeciesReport report = write_species(request, folder / "one", source, *make_serial_executor());
  write_species(request, folder / "two", source, *make_thread_executor(3));
  EXPECT_EQ(report.found, 6u);
  EXPECT_LE(report.triangles, 4000u);
  const auto files = read_tree(folder / "one");
  EXPECT_EQ(files, read_tree(folder / "two"));
  for (const char* name : {"001.glb", "006.glb", "006.derivation.json", "species.json", "species.png", "breed.toml"}) {
    EXPECT_TRUE(files.count(name)) << name;
  }
  const auto index = nlohmann::json::parse(files.at("species.json"));
  EXPECT_EQ(index["found"], 6);
  EXPECT_EQ(index["models"].size(), 6u);
  EXPECT_THAT(index["words"].get<std::string>(), HasSubstr("6 of 6 found among"));
  // Derivations find their grammar and its attributes by themselves.
  const LoadedDerivation loaded = load_derivation(folder / "one/002.derivation.json", "", {});
  EXPECT_EQ(loaded.grammar.graph->name, "gentree");
  EXPECT_EQ(loaded.grammar.attributes.at("leafy"), "false");
}

TEST(SpeciesPack, SiblingsOfAModelAreMadeAgainFromTheirFolder) {
  const TemporaryFolder folder;
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  write_species(request_for(kGrammar, 2), folder / "first", source, *executor);
  SpeciesRequest request = request_for(folder / "first/002.glb", 4);
  request.most_triangles = 100'000;
  ASSERT_EQ(write_species(request, folder / "out", source, *executor).found, 4u);
  const auto index = nlohmann::json::parse(read_text(folder / "out/species.json"));
  EXPECT_EQ(index["make_again"], "espalier breed --from inputs/start/002.derivation.json --grammar inputs/gentree.esp --count 4 "
                                 "--seed 1 --strength 0.3 --least-distance 0.01 --format glb --max-triangles 100000 --out OUT");
  request.from = folder / "out/inputs/start/002.derivation.json";
  request.grammar = folder / "out/inputs/gentree.esp";
  write_species(request, folder / "again", source, *executor);
  EXPECT_EQ(read_tree(folder / "out"), read_tree(folder / "again"));
}

TEST(SpeciesPack, LevelsOfDetailAreFilesEachAndTheLimitIsOfTheFinest) {
  const TemporaryFolder folder;
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  SpeciesRequest request = request_for(kGrammar, 3);
  request.most_triangles = 3000;
  request.form.detail = LevelOfDetail{0, Joints::smooth};
  request.form.all_levels = true;
  const SpeciesReport report = write_species(request, folder / "out", source, *executor);
  ASSERT_EQ(report.found, 3u);
  EXPECT_LE(report.triangles, 3000u);
  EXPECT_GT(report.triangles, 0u);
  const auto index = nlohmann::json::parse(read_text(folder / "out/species.json"));
  EXPECT_THAT(index["make_again"].get<std::string>(), HasSubstr("--joints smooth --lods --max-triangles 3000 "));
  for (const auto& model : index["models"]) {
    ASSERT_EQ(model["levels"].size(), 4u);
    EXPECT_EQ(model["file"], model["levels"][0]["file"]);
    for (std::size_t level = 0; level < 4; ++level) {
      const std::string file = model["levels"][level]["file"];
      EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + file))) << file;
      if (level == 0) continue;
      EXPECT_LT(model["levels"][level]["triangles"], model["levels"][level - 1]["triangles"]) << file;
    }
  }
  // The limit is of the level that is written, not of the model as the grammar makes it.
  request.form.detail->level = 2;
  request.form.all_levels = false;
  request.most_triangles = 1;
  EXPECT_THAT(write_species(request, folder / "none", source, *executor).words, HasSubstr("refused: triangles are above max ("));
}

TEST(SpeciesPack, WritesNothingWhereNothingIsFoundAndReplacesOnlyItsOwn) {
  const TemporaryFolder folder;
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  SpeciesRequest request = request_for(kGrammar, 2);
  request.most_triangles = 1;
  const SpeciesReport report = write_species(request, folder / "out", source, *executor);
  EXPECT_EQ(report.found, 0u);
  EXPECT_THAT(report.words, HasSubstr("0 of 2 found among 120 candidates"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  testing::write_text(folder / "mine/letter.txt", "dear");
  EXPECT_THROW(write_species(request_for(kGrammar, 2), folder / "mine", source, *executor), Error);
  EXPECT_EQ(read_tree(folder / "mine").size(), 1u);
  request.form.format = "max";
  EXPECT_THROW(write_species(request, folder / "out", source, *executor), Error);
}

}  // namespace
}  // namespace espalier
