// Runs with Genesis, whose genomes are the draws of the start rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/reproduce.h"
#include "run/resuming.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::comparable;
using testing::read_text;
using testing::run_in;
using testing::TemporaryFolder;
using testing::write_text;

constexpr const char* kPost = R"(grammar post 1
start Post
rule Post {
  tall ~ uniform(0.5, 6)
  wide ~ uniform(0.2, 3)
  deep ~ uniform(0.2, 3)
  floors ~ integer(1, 8)
  detail Floor(tall / floors, floors)
}
detail Floor(high, left) {
  { move y high / 2  size (wide, high, deep)  emit box }
  if left > 1 { move y high  detail Floor(high, left - 1) }
}
)";

void write_post(const TemporaryFolder& folder, const std::string& more = "") {
  testing::write_pile(folder, "espalier = 1\ngrammar = \"post.esp\"\nseed = 3\n[budget]\ngenerations = 12\n[search]\n"
                              "engine = \"genesis\"\n" + more + "[volume]\ncells = 20000\n[[volume.mesh]]\n"
                              "file = \"meshes/tower.obj\"\n[output]\nkeep = 2\npicture = [64, 48]\n");
  write_text(folder / "post.esp", kPost);
}

TEST(GenesisRun, SameSeedSameBytesForAnyNumberOfThreadsAndIsReproduced) {
  const TemporaryFolder folder;
  write_post(folder, "population = 20\nbits = [8, 8, 8, 3]\n");
  ASSERT_TRUE(run_in(folder, "one", 1));
  ASSERT_TRUE(run_in(folder, "two", 2));
  EXPECT_EQ(comparable(folder / "one"), comparable(folder / "two"));
  const auto result = nlohmann::json::parse(read_text(folder / "one/result.json"));
  EXPECT_EQ(result["engine"], "genesis");
  EXPECT_EQ(result["genes"], 1);
  EXPECT_GT(result["percent"], 60);
  EXPECT_THAT(read_text(folder / "one/run.toml"), HasSubstr("bits = [8, 8, 8, 3]"));
  AssimpMeshSource source;
  const ReproduceReport report = reproduce(folder / "one/best.derivation.json", "", source, *make_serial_executor());
  EXPECT_TRUE(report.identical()) << ::testing::PrintToString(report.differences);
}

TEST(GenesisRun, SettingsAreReadAndWritten) {
  const TemporaryFolder folder;
  write_post(folder, "[engine.genesis]\npopulation = 30\ncrossover = 0.5\nmutation = 0.01\ngap = 0.9\n"
                     "selection = \"ranking\"\nwindow = 7\nrank_min = 0.5\nelitism = false\ngray = false\nidle = 5\n");
  const Scene scene = load_scene(folder / "scene.toml", {});
  const GenesisSettings& s = scene.search.genesis;
  GenesisSettings expected;
  expected.population = 30, expected.crossover = 0.5, expected.mutation = 0.01, expected.gap = 0.9;
  expected.selection = GenesisSelection::ranking, expected.window = 7, expected.rank_min = 0.5;
  expected.elitism = expected.gray = false, expected.idle = 5;
  EXPECT_EQ(s, expected);
  const Scene again = parse_scene(to_toml(scene), "again.toml", scene.folder, {});
  EXPECT_EQ(again.search, scene.search);
}

TEST(GenesisRun, RefusesGrammarsThatGrowAndListsOfTheWrongLength) {
  const TemporaryFolder folder;
  testing::write_pile(folder);
  const auto error_of = [&](const SceneOverrides& overrides) -> std::string {
    try {
      run_in(folder, "out", 1, nullptr, nullptr, overrides);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(error_of({{"search.engine=genesis"}, {}}), HasSubstr("rule Pile has the slot Block"));
  write_post(folder);
  EXPECT_THAT(error_of({{"engine.genesis.bits=[8, 8]"}, {}}), HasSubstr("each of the 4 draws of rule Post, got 2"));
  EXPECT_THAT(error_of({{"engine.genesis.bits=[8, 8, 0, 1]"}, {}}), HasSubstr("bits"));
  EXPECT_THAT(error_of({{"engine.genesis.bits=7"}, {}}), HasSubstr("bits"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace espalier
