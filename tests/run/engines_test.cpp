// Every engine on one scene, which was written for the genetic algorithm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/make_engine.h"
#include "run/reproduce.h"
#include "run/run_folders.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::comparable;
using testing::pile_scene;
using testing::read_text;
using testing::run_in;
using testing::TemporaryFolder;

class Engines : public ::testing::TestWithParam<std::string_view> {
 protected:
  SceneOverrides chosen() const {
    return {{"search.engine=" + std::string(GetParam()), "engine.hybrid.turn=200", "engine.sosmc.particles=30"},
            {}};
  }
};

TEST_P(Engines, SameSeedSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene("generations = 60"));
  ASSERT_TRUE(run_in(folder, "one", 1, nullptr, nullptr, chosen()));
  ASSERT_TRUE(run_in(folder, "two", 2, nullptr, nullptr, chosen()));
  EXPECT_EQ(comparable(folder / "one"), comparable(folder / "two"));
  const auto result = nlohmann::json::parse(read_text(folder / "one/result.json"));
  EXPECT_EQ(result["engine"], GetParam());
  EXPECT_GT(result["percent"], 40);
  EXPECT_LE(result["genes"], 40);
  EXPECT_GE(result["alternatives"].size(), 1u);
  EXPECT_THAT(read_text(folder / "one/run.toml"), HasSubstr("engine = \"" + std::string(GetParam()) + "\""));
}

TEST_P(Engines, RunsAreReproduced) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out", 1, nullptr, nullptr, chosen()));
  AssimpMeshSource source;
  const ReproduceReport report = reproduce(folder / "out/best.derivation.json", "", source, *make_serial_executor());
  EXPECT_TRUE(report.identical()) << ::testing::PrintToString(report.differences);
}

INSTANTIATE_TEST_SUITE_P(Run, Engines, ::testing::ValuesIn(testing::kGrowingEngines),
                         [](const auto& engine) { return std::string(engine.param); });

Scene parse(const std::string& tables, const SceneOverrides& overrides = {}) {
  return parse_scene(
      "espalier = 1\ngrammar = \"g.esp\"\n[budget]\nseconds = 1\n[[volume.mesh]]\nfile = \"m.obj\"\n" + tables,
      "s.toml", "", overrides);
}

std::string error_of(const std::string& tables, const SceneOverrides& overrides = {}) {
  try {
    parse(tables, overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneEngines, SettingsOfTheFileAreForTheEngineOfTheFile) {
  const std::string written = "[search]\nengine = \"sosmc\"\nparticles = 70\n[engine.rjmcmc]\nchains = 4\n";
  const Scene as_it_is = parse(written);
  EXPECT_EQ(as_it_is.search.engine, EngineKind::sosmc);
  EXPECT_EQ(as_it_is.search.sosmc.particles, 70u);
  EXPECT_EQ(as_it_is.search.smc.particles, 500u);
  const Scene other = parse(written, {{"search.engine=rjmcmc", "search.jumps=2"}, {}});
  EXPECT_EQ(other.search.engine, EngineKind::rjmcmc);
  EXPECT_EQ(other.search.sosmc.particles, 70u);
  EXPECT_EQ(other.search.rjmcmc.chains, 4u);
  EXPECT_EQ(other.search.rjmcmc.temperatures, 4u) << "as many as there are chains";
  EXPECT_EQ(other.search.rjmcmc.jumps, 2);
  EXPECT_EQ(parse("", {{"engine.smc.particles=20000"}, {}}).search.smc.most_particles, 20000u);
}

TEST(SceneEngines, ShareLimitsAndFirstLengths) {
  const Scene scene = parse("[engine.ga]\ninitial_length = [7, 9]\n[engine.smc]\ninitial_length = 5\n"
                            "[limits.genes]\nmin = 3\nmax = 33\n");
  EXPECT_EQ(scene.search.rjmcmc.genes, (GeneLimits{3, 33}));
  EXPECT_EQ(scene.search.sosmc.genes, (GeneLimits{3, 33}));
  EXPECT_EQ(scene.search.rjmcmc.initial_length_max, 9u);
  EXPECT_EQ(scene.search.sosmc.initial_length_min, 7u);
  EXPECT_EQ(scene.search.smc.initial_length_max, 5u);
}

TEST(SceneEngines, EverySettingIsWrittenAndReadAgain) {
  const Scene scene = parse(
      "[search]\nengine = \"hybrid\"\nturn = 9\nsweeps = 2\n"
      "[engine.smc]\nparticles = 9\nschedule = 1.5\nmost_particles = 99\nsteps = 7\nresampling = \"residual\"\n"
      "resample_below = 1\nweight = \"ratio\"\ntemperature = 3\n"
      "[engine.rjmcmc]\nchains = 9\ntemperatures = 3\nheat = 5\ntemperature = 0.5\nanneal = 1.1\nanneal_every = 5\n"
      "anneal_most = 7\ndraws = 1\nnudges = 2\nslots = 3\njumps = 4\nchoice = \"uniform\"\ndelayed = false\n"
      "swap_every = 0\n");
  const Scene again = parse_scene(to_toml(scene), "w", "");
  EXPECT_EQ(again.search, scene.search);
  EXPECT_EQ(again.search.smc.resampling, Resampling::residual);
  EXPECT_EQ(again.search.rjmcmc.jumps, 4);
  EXPECT_FALSE(again.search.rjmcmc.delayed);
  EXPECT_EQ(again.search.hybrid.sweeps, 2u);
}

TEST(SceneEngines, BadSettingsAreNamed) {
  EXPECT_THAT(error_of("[engine.rjmcmc]\nchains = 0\n"), HasSubstr("s.toml:8:10: engine.rjmcmc.chains must be"));
  EXPECT_THAT(error_of("[engine.rjmcmc]\nchain = 3\n"), HasSubstr("did you mean engine.rjmcmc.chains?"));
  EXPECT_THAT(error_of("[engine.sosmc]\nresampling = \"best\"\n"), HasSubstr("engine.sosmc.resampling must be one of"));
  EXPECT_THAT(error_of("[search]\nengine = \"rjmcmc\"\nchains = 3\ntemperatures = 4\n"),
              HasSubstr("search.temperatures must be between 1 and 3, got 4"));
  EXPECT_THAT(error_of("[search]\npopulation = 5\n", {{"search.engine=rjmcmc", "search.population=7"}, {}}),
              HasSubstr("search.population"));
}

}  // namespace
}  // namespace espalier
