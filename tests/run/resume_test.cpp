// Runs that go on from checkpoints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run/folder_lock.h"
#include "run/reproduce.h"
#include "run/resuming.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::partial_folders;
using testing::read_text;
using testing::Resuming;
using testing::Telling;
using testing::write_text;

namespace fs = std::filesystem;

class ResumingEngines : public Resuming, public ::testing::WithParamInterface<std::string_view> {
 protected:
  SceneOverrides chosen() const { return {{"search.engine=" + std::string(GetParam())}, {}}; }
};

TEST_P(ResumingEngines, MakeTheFolderOfARunThatNeverStopped) {
  leave("out.partial-aaaaaa", 17, chosen(), 2);
  const std::uint64_t step = step_in("out.partial-aaaaaa");
  EXPECT_GT(step, 0u);
  Telling observer;
  resume({.folder = "out", .threads = 1}, observer);
  EXPECT_EQ(observer.resumed_from, step);
  EXPECT_EQ(observer.first_step, step + 1);
  EXPECT_THAT(observer.folder, HasSubstr("/out.partial-aaaaaa"));
  EXPECT_EQ(observer.warnings, "");
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
  EXPECT_EQ(step_in("out"), 40u);
  EXPECT_TRUE(partial_folders(folder_).empty());
  EXPECT_FALSE(fs::exists(folder_ / "out/.lock"));
  AssimpMeshSource source;
  const ReproduceReport report = reproduce(folder_ / "out/best.derivation.json", "", source, *make_serial_executor());
  EXPECT_TRUE(report.identical()) << ::testing::PrintToString(report.differences);

  // A finished run too, with a larger budget.
  SceneOverrides shorter = chosen();
  shorter.settings.push_back("budget.generations=13");
  ASSERT_TRUE(run("short", 1000, observer, shorter));
  EXPECT_EQ(step_in("short"), 13u);
  Telling longer;
  resume({.folder = "short", .budget = {.generations = 40}}, longer);
  EXPECT_EQ(longer.resumed_from, 13u);
  testing::expect_same_results(folder_ / "short", folder_ / "whole");
}

INSTANTIATE_TEST_SUITE_P(Run, ResumingEngines, ::testing::ValuesIn(testing::kGrowingEngines),
                         [](const auto& engine) { return std::string(engine.param); });

TEST_F(Resuming, WithoutCheckpointsThereAreNone) {
  Telling observer;
  ASSERT_TRUE(run("out", 0, observer));
  EXPECT_FALSE(fs::exists(folder_ / "out/checkpoint"));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("out: holds no checkpoint, nor does any "));
  EXPECT_THAT(error_of({.folder = "nowhere/else"}), HasSubstr("holds no checkpoint"));
}

TEST_F(Resuming, WhatWasHalfWrittenIsRemoved) {
  leave("out.partial-aaaaaa", 12);
  const std::string checkpoint = read_text(folder_ / "out.partial-aaaaaa/checkpoint");
  write_text(folder_ / "out.partial-aaaaaa/.espalier-123-4.tmp", checkpoint.substr(0, 1000));
  write_text(folder_ / "out.partial-aaaaaa/inputs/targets/.espalier-123-5.tmp", "stale");
  write_text(folder_ / "out.partial-aaaaaa/alternatives/77.glb", "stale");
  resume({.folder = "out"});
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
}

TEST_F(Resuming, ADamagedCheckpointIsRefused) {
  leave("out.partial-aaaaaa", 12);
  const std::string path = folder_ / "out.partial-aaaaaa/checkpoint", checkpoint = read_text(path);
  write_text(path, checkpoint.substr(0, checkpoint.size() / 2));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("/checkpoint: cannot be continued from: it is damaged: "));
  std::string flipped = checkpoint;
  flipped[checkpoint.size() / 2] ^= 4;
  write_text(path, flipped);
  EXPECT_THAT(error_of({.folder = "out", .force = true}), HasSubstr("checksum"));
  EXPECT_TRUE(fs::exists(path));
}

TEST_F(Resuming, WhatHasChangedIsNamed) {
  leave("out.partial-aaaaaa", 12);
  const auto at = [&](const char* name) { return folder_ / (std::string("out.partial-aaaaaa/") + name); };
  const std::string grammar = read_text(at("inputs/pile.esp")), settings = read_text(at("run.toml"));
  write_text(at("inputs/pile.esp"), grammar + "# a word\n");
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("inputs/pile.esp is not what it was"));
  write_text(at("inputs/pile.esp"), grammar);
  fs::rename(at("inputs/targets/drawing.png"), at("inputs/targets/gone.png"));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("inputs/targets/drawing.png is missing"));
  fs::rename(at("inputs/targets/gone.png"), at("inputs/targets/drawing.png"));
  std::string changed = settings;
  changed.replace(changed.find("population = 24"), 15, "population = 25");
  write_text(at("run.toml"), changed);
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("run.toml: engine.ga.population is 25, was 24"));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("--force"));
  Checkpoint other = read_checkpoint(at("checkpoint"));
  other.version = "0.0.1";
  write_text(at("run.toml"), settings);
  write_text(at("checkpoint"), encode_checkpoint(other));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("the checkpoint was written by 0.0.1"));
  other.version = read_checkpoint(folder_ / "whole/checkpoint").version;
  other.state[8] ^= 1;  // the version of the state
  write_text(at("checkpoint"), encode_checkpoint(other));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("saved state: version must be"));
}

TEST_F(Resuming, ForcedTheModelsGoOnInANewSearch) {
  leave("out.partial-aaaaaa", 30);
  const std::string path = folder_ / "out.partial-aaaaaa/inputs/pile.esp";
  std::string grammar = read_text(path);
  grammar.replace(grammar.find("vec(0.7)"), 8, "vec(0.8)");
  write_text(path, grammar);
  Telling observer;
  resume({.folder = "out", .budget = {.generations = 3}, .force = true}, observer);
  EXPECT_EQ(observer.first_step, 1u);
  EXPECT_EQ(observer.resumed_from, 0u);
  EXPECT_THAT(observer.warnings, HasSubstr("this is a new search"));
  EXPECT_THAT(observer.warnings, HasSubstr("inputs/pile.esp is not what it was"));
  EXPECT_EQ(read_text(folder_ / "out/inputs/pile.esp"), grammar);
  EXPECT_TRUE(fs::exists(folder_ / "out.partial-aaaaaa/checkpoint")) << "nothing is lost";
  // It begins about as good as the other one was, not from nothing.
  const auto score = [&](const char* file) {
    return nlohmann::json::parse(read_text(folder_ / file))["score"].get<double>();
  };
  EXPECT_GT(score("out/result.json"), 0.8 * score("whole/result.json"));
  AssimpMeshSource source;
  const ReproduceReport report = reproduce(folder_ / "out/best.glb", "", source, *make_serial_executor());
  EXPECT_TRUE(report.identical()) << ::testing::PrintToString(report.differences);
}

TEST_F(Resuming, ForcedNothingOfAnotherGrammarStands) {
  leave("out.partial-aaaaaa", 12);
  const std::string path = folder_ / "out.partial-aaaaaa/inputs/pile.esp";
  std::string grammar = read_text(path);
  for (std::size_t at; (at = grammar.find("Block")) != std::string::npos;) grammar.replace(at, 5, "Brick");
  write_text(path, grammar);
  EXPECT_THAT(error_of({.folder = "out", .force = true}), HasSubstr("none of the checkpoint's models can stand in it"));
}

TEST_F(Resuming, WithNothingChangedForceChangesNothing) {
  leave("out.partial-aaaaaa", 12);
  resume({.folder = "out", .force = true});
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
}

TEST_F(Resuming, SeveralFoldersAreListed) {
  leave("out.partial-aaaaaa", 12);
  fs::copy(folder_ / "out.partial-aaaaaa", folder_ / "out.partial-bbbbbb", fs::copy_options::recursive);
  const std::string error = error_of({.folder = "out"});
  EXPECT_THAT(error, HasSubstr("/out.partial-aaaaaa (step "));
  EXPECT_THAT(error, HasSubstr("/out.partial-bbbbbb (step "));
  resume({.folder = "out.partial-bbbbbb"});
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
  EXPECT_TRUE(fs::exists(folder_ / "out.partial-aaaaaa"));
  EXPECT_FALSE(fs::exists(folder_ / "out.partial-bbbbbb"));
}

TEST_F(Resuming, AFinishedRunOfAnotherSearchIsNotReplacedUnasked) {
  leave("out.partial-aaaaaa", 12);
  Telling observer;
  ASSERT_TRUE(run("out", 1000, observer, {{"seed=77"}, {}}));
  EXPECT_THAT(observer.warnings, HasSubstr("an interrupted run left "));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("is a finished run (step 40), and "));
  resume({.folder = "out.partial-aaaaaa"});
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
}

TEST_F(Resuming, AFolderIsContinuedByOneProcess) {
  leave("out.partial-aaaaaa", 12);
  {
    const auto lock = FolderLock::take(folder_ / "out.partial-aaaaaa");
    ASSERT_TRUE(lock);
    EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("out.partial-aaaaaa: process "));
    EXPECT_THAT(error_of({.folder = "out.partial-aaaaaa"}), HasSubstr("still at work"));
  }
  resume({.folder = "out"});
}

TEST_F(Resuming, MayGoElsewhere) {
  leave("out.partial-aaaaaa", 12);
  Telling observer;
  resume({.folder = "out"}, observer, "deep/other");
  testing::expect_same_results(folder_ / "deep/other", folder_ / "whole");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_TRUE(partial_folders(folder_).empty());
}

TEST_F(Resuming, BudgetsAreOfTheWholeRun) {
  Telling observer;
  ASSERT_TRUE(run("out", 1000, observer));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("40 of 40 generations are done"));
  EXPECT_THAT(error_of({.folder = "out", .budget = {.evaluations = 300}}), HasSubstr("of 300 evaluations are done"));
  EXPECT_THAT(error_of({.folder = "out", .budget = {.seconds = 1e-3}}), HasSubstr("seconds are over"));
  resume({.folder = "out", .budget = {.evaluations = 2000}});
  const auto result = nlohmann::json::parse(read_text(folder_ / "out/result.json"));
  EXPECT_EQ(result["stopped_by"], "evaluations");
  EXPECT_GE(result["evaluations"], 2000);
  EXPECT_LT(result["evaluations"], 2030);
  EXPECT_EQ(read_text(folder_ / "out/run.toml").find("generations = 40"), std::string::npos);
}

TEST_F(Resuming, ACheckpointThatCannotBeWrittenIsToldAndTheSearchGoesOn) {
  Telling observer;
  observer.on_step = [&](const StepReport& report) {
    if (report.step != 5) return;
    for (const std::string& partial : partial_folders(folder_)) {
      fs::remove(fs::path(partial) / kCheckpointName);
      fs::create_directories(fs::path(partial) / kCheckpointName / "in the way");
    }
  };
  EXPECT_TRUE(run("out", 1e-9, observer));
  EXPECT_THAT(observer.warnings, HasSubstr("no checkpoint at step "));
  EXPECT_TRUE(fs::exists(folder_ / "out/best.glb"));
}

}  // namespace
}  // namespace espalier
