#include "run/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/drawing_fixtures.h"
#include "run/explanation_json.h"
#include "run/fixtures.h"
#include "run/run_folders.h"
#include "run/report_page.h"
#include "run/reproduce.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::pile_scene;
using testing::read_text;
using testing::comparable;
using testing::read_tree;
using testing::run_in;
using testing::TemporaryFolder;
using testing::write_pile;
using testing::write_text;

namespace fs = std::filesystem;

/// Remembers what it was told.
class Recorder final : public RunObserver {
 public:
  void step(const StepReport& report) override {
    steps.push_back(report);
    if (on_step) on_step(report);
  }
  void gauges(const StepReport& report, const std::vector<NamedGauge>&) override { gauge_steps.push_back(report.step); }
  void finished(const RunEnd& end) override { ends.push_back(end); }

  std::vector<std::uint64_t> gauge_steps;
  std::vector<StepReport> steps;
  std::vector<RunEnd> ends;
  std::function<void(const StepReport&)> on_step;
};

TEST(Run, LeavesAWholeFolder) {
  const TemporaryFolder folder;
  write_pile(folder);
  Recorder recorder;
  ASSERT_TRUE(run_in(folder, "out", 1, &recorder));
  std::vector<std::string> names;
  for (const auto& [name, text] : read_tree(folder / "out")) {
    names.push_back(name);
    EXPECT_FALSE(text.empty()) << name;
  }
  EXPECT_THAT(names, ElementsAre("alternatives.png", "alternatives/01.derivation.json", "alternatives/01.glb",
                                 "alternatives/01.png", "alternatives/02.derivation.json", "alternatives/02.glb",
                                 "alternatives/02.png", "best.derivation.json", "best.glb", "best.mtl", "best.obj",
                                 "best.png", "convergence.csv", "diagnostics.csv", "inputs/pile.esp",
                                 "inputs/targets/tower.obj", "report.html", "result.json", "run.toml", "volume.png"));
  const auto result = nlohmann::json::parse(read_text(folder / "out/result.json"));
  ASSERT_EQ(recorder.ends.size(), 1u);
  EXPECT_EQ(result["score"], recorder.ends[0].score);
  EXPECT_EQ(result["score"], recorder.steps.back().best);
  EXPECT_EQ(result["steps"], 6);
  EXPECT_EQ(recorder.steps.size(), 6u);
  EXPECT_EQ(result["stopped_by"], "generations");
  EXPECT_EQ(result["provenance"]["inputs"].size(), 2u);
  EXPECT_FALSE(result["words"].get<std::string>().empty());
  EXPECT_EQ(result["alternatives"].size(), 2u);
  EXPECT_LE(result["alternatives"][0]["score"], result["score"]);
  for (const std::string& file : recorder.ends[0].files) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST(Run, TellsHowTheEngineDid) {
  const TemporaryFolder folder;
  write_pile(folder);
  Recorder recorder;
  ASSERT_TRUE(run_in(folder, "out", 1, &recorder));
  const auto result = nlohmann::json::parse(read_text(folder / "out/result.json"));
  const std::string csv = read_text(folder / "out/diagnostics.csv");
  EXPECT_TRUE(csv.starts_with("step,evaluations,seconds,evaluations_per_second,")) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7) << "a line of names and one per step";
  EXPECT_EQ(recorder.gauge_steps, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_GE(result["engine_gauges"]["alternatives"], 2);
  EXPECT_GE(result["alternatives_spread"], 0.2) << "the least distance of any two";
  EXPECT_LE(result["alternatives_spread"], 1);
  EXPECT_EQ(recorder.ends[0].spread, result["alternatives_spread"]);
  EXPECT_THAT(read_text(folder / "out/report.html"), HasSubstr("<th scope=\"row\">spread</th>"));
}

TEST(Run, SameSeedSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "one", 1));
  ASSERT_TRUE(run_in(folder, "two", 2));
  ASSERT_TRUE(run_in(folder, "five", 5));
  const auto one = comparable(folder / "one");
  EXPECT_EQ(one, comparable(folder / "two"));
  EXPECT_EQ(one, comparable(folder / "five"));
}

constexpr const char* kHardLimits =
    "[limits.height]\nmax = 3.5\nfrom = 2\nto = 3.5\nweight = 100\n[limits.depth]\nmin = 2\nmax = 6\n"
    "[limits.balance]\nmin = 0.1\nfrom = 0.5\nto = 0.1\nweight = 50\n[limits.volume]\nmax = 25\n";

TEST(Run, HardLimitsHoldForAllThatIsKeptAndAreReproduced) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene("generations = 12") + kHardLimits);
  ASSERT_TRUE(run_in(folder, "one", 1));
  ASSERT_TRUE(run_in(folder, "four", 4));
  EXPECT_EQ(comparable(folder / "one"), comparable(folder / "four"));
  const auto result = nlohmann::json::parse(read_text(folder / "one/result.json"));
  EXPECT_THAT(result["words"].get<std::string>(), HasSubstr("height "));
  const auto& terms = result["targets"][1]["terms"];
  ASSERT_EQ(terms.size(), 5u);  // genes too
  EXPECT_EQ(terms[2]["name"], "height");
  EXPECT_EQ(terms[2]["unit"], "m");
  EXPECT_LE(terms[2]["count"], 3.5);
  std::uint64_t most = 0, sum = 0;
  for (const auto& [name, rejected] : result["rejections"].items()) {
    most = std::max(most, rejected["models"].get<std::uint64_t>());
    sum += rejected["models"].get<std::uint64_t>();
  }
  const auto& counts = result["engine_counts"];
  const std::uint64_t all =
      counts["rejected children"].get<std::uint64_t>() + counts["rejected starts"].get<std::uint64_t>();
  EXPECT_GT(most, 0u);
  EXPECT_LE(most, all);
  EXPECT_GE(sum, all);  // a model may break several
  EXPECT_GT(result["rejections"]["height"]["lowest"], 3.5);
  EXPECT_EQ(result["rejections"]["genes"]["models"], 0);  // the engine keeps to those by itself
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  EXPECT_TRUE(reproduce(folder / "one/result.json", "", source, *executor).identical());
  for (const char* name : {"best", "alternatives/01", "alternatives/02"}) {
    const std::string file = folder / "one/" + name + ".derivation.json";
    if (!fs::exists(file)) continue;
    EXPECT_EQ(score_derivation(load_scene(folder / "one/run.toml"), file, source).rejected, "") << name;
  }
}

TEST(Run, LimitsThatNoModelMeetsAreAnErrorWithTheValuesMet) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene() + "[limits.height]\nmax = 0.25\n[limits.spread]\nmin = 100\n");
  try {
    run_in(folder, "out");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("none of 1200 models grown from grammar pile is acceptable: limits.height "
                                        "allows at most 0.25 m; 1200 had "));
    EXPECT_THAT(error.what(), HasSubstr(" m; limits.spread allows at least 100 m; 1200 had "));
  }
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Run, AnotherSeedIsAnotherModel) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "one"));
  write_text(folder / "scene.toml", pile_scene().replace(pile_scene().find("seed = 3"), 8, "seed = 4"));
  ASSERT_TRUE(run_in(folder, "two"));
  EXPECT_NE(read_text(folder / "one/best.glb"), read_text(folder / "two/best.glb"));
}

TEST(Run, TheFolderRunsAgainElsewhere) {
  const TemporaryFolder folder, elsewhere;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out"));
  fs::copy(folder / "out", elsewhere / "copy", fs::copy_options::recursive);
  fs::remove_all(folder.path());
  AssimpMeshSource source;
  ASSERT_TRUE(run_scene(load_scene(elsewhere / "copy/run.toml"), {elsewhere / "again", nullptr, nullptr}, source));
  EXPECT_EQ(comparable(elsewhere / "copy"), comparable(elsewhere / "again"));
}

TEST(Run, BudgetsEndIt) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene("evaluations = 60\nseconds = 1000"));
  Recorder recorder;
  ASSERT_TRUE(run_in(folder, "out", 1, &recorder));
  EXPECT_EQ(recorder.ends[0].stopped_by, "evaluations");
  EXPECT_GE(recorder.ends[0].evaluations, 60u);
  EXPECT_LT(recorder.steps[recorder.steps.size() - 2].evaluations, 60u);
  write_pile(folder, pile_scene("seconds = 0.001\nevaluations = 1000000000"));
  ASSERT_TRUE(run_in(folder, "out", 1, &recorder));
  EXPECT_EQ(recorder.ends[1].stopped_by, "seconds");
}

TEST(Run, StoppedItKeepsTheBestSoFarAndCanBeReproduced) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene("generations = 1000000"));
  std::atomic<bool> stop{false};
  Recorder recorder;
  recorder.on_step = [&](const StepReport& report) { stop = report.step == 4; };
  ASSERT_TRUE(run_in(folder, "out", 1, &recorder, &stop));
  EXPECT_EQ(recorder.ends[0].stopped_by, "interrupt");
  EXPECT_EQ(recorder.ends[0].steps, 4u);
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  EXPECT_TRUE(reproduce(folder / "out/best.glb", "", source, *executor).identical());
}

TEST(Run, StoppedBeforeItBeganLeavesNothing) {
  const TemporaryFolder folder;
  write_pile(folder);
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(run_in(folder, "out", 1, nullptr, &stop));
  EXPECT_THAT(read_tree(folder.path()), ::testing::SizeIs(3));
}

TEST(Run, ErrorsLeaveNoFolder) {
  const TemporaryFolder folder;
  for (const char* spoilt : {"pile.esp", "meshes/tower.obj"}) {
    write_pile(folder);
    write_text(folder / spoilt, "\x01 nonsense");
    EXPECT_THROW(run_in(folder, "out"), Error) << spoilt;
  }
  write_pile(folder, pile_scene() + "[volume.grid]\nmin = [90, 90, 90]\nmax = [91, 91, 91]\ncells = [4, 4, 4]\n");
  EXPECT_THROW(run_in(folder, "out"), Error) << "a target that covers no voxel";
  std::string scene = pile_scene();
  scene.replace(scene.find("min = 2"), 7, "min = 30");
  scene.replace(scene.find("[5, 15]"), 7, "35");
  write_pile(folder, scene);
  write_text(folder / "pile.esp", "grammar pile 1\nstart P\nrule P { k ~ uniform(1, 2)  size k  emit box }\n");
  EXPECT_THROW(run_in(folder, "out"), Error) << "no derivation of that many genes";
  EXPECT_THAT(read_tree(folder.path()), ::testing::SizeIs(3));
}

TEST(Run, EveryFileIsReproducedIdentically) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out", 2));
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  for (const char* name : {"best.glb", "best.obj", "best.mtl", "best.png", "best.derivation.json", "result.json",
                           "alternatives.png", "alternatives/01.glb", "alternatives/02.png",
                           "alternatives/02.derivation.json", "volume.png"}) {
    const ReproduceReport report = reproduce(folder / "out/" + name, "", source, *executor);
    EXPECT_TRUE(report.identical()) << name << ": " << ::testing::PrintToString(report.differences);
    EXPECT_EQ(report.same.size(), 4u) << name;  // two inputs, derivation, bytes
  }
}

TEST(Run, PicturesOfTargetsAreReproducedIdentically) {
  const TemporaryFolder folder;
  testing::write_drawing(folder);
  write_text(folder / "scene.toml",
             testing::drawing_scene(std::string(testing::kTowerVolume) + testing::kPinhole + testing::kWall));
  ASSERT_TRUE(run_in(folder, "out", 2));
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  for (const char* name : {"view-01.png", "view-02.png", "silhouette-01.png", "silhouette-02.png", "volume.png"}) {
    const ReproduceReport report = reproduce(folder / "out/" + name, "", source, *executor);
    EXPECT_TRUE(report.identical()) << name << ": " << ::testing::PrintToString(report.differences);
  }
  write_text(folder / "scene.toml", testing::drawing_scene(testing::kParallel));
  ASSERT_TRUE(run_in(folder, "one"));
  EXPECT_TRUE(fs::exists(folder / "one/view.png"));
  EXPECT_TRUE(fs::exists(folder / "one/silhouette.png"));
  EXPECT_FALSE(fs::exists(folder / "one/volume.png"));
}

TEST(Reproduce, TellsWhatDiffers) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out"));
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  const auto differences = [&](const std::string& name) {
    return reproduce(folder / name, folder / "out", source, *executor).differences;
  };
  std::string glb = read_text(folder / "out/best.glb");
  glb.back() = static_cast<char>(glb.back() ^ 1);
  write_text(folder / "touched/best.glb", glb);
  EXPECT_THAT(differences("touched/best.glb"), ElementsAre(HasSubstr("best.glb differs from byte")));
  write_text(folder / "out/inputs/pile.esp", read_text(folder / "out/inputs/pile.esp") + "# more\n");
  EXPECT_THAT(differences("out/best.glb"), ElementsAre(HasSubstr("inputs/pile.esp has changed since")));
  fs::remove(folder / "out/inputs/pile.esp");
  EXPECT_THROW(differences("out/best.glb"), Error);
  EXPECT_THROW(differences("scene.toml"), Error);
}

TEST(Reproduce, FindsAFileThatWasMovedAndRenamed) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out"));
  fs::copy(folder / "out/alternatives/02.glb", folder / "dear.glb");
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  EXPECT_THROW(reproduce(folder / "dear.glb", "", source, *executor), Error);  // its inputs are not beside it
  EXPECT_TRUE(reproduce(folder / "dear.glb", folder / "out", source, *executor).identical());
}

TEST(ScoreDerivation, AgreesWithTheRun) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out"));
  const auto result = nlohmann::json::parse(read_text(folder / "out/result.json"));
  AssimpMeshSource source;
  for (const char* scene : {"scene.toml", "out/run.toml"}) {
    const Explanation e = score_derivation(load_scene(folder / scene), folder / "out/best.derivation.json", source);
    EXPECT_EQ(e.score, result["score"]);
    EXPECT_EQ(e.optimum, result["optimum"]);
    EXPECT_EQ(e.words, result["words"]);
    double sum = 0;
    for (const Explanation& target : e.targets) {
      for (const Term& term : target.terms) sum += target.weight * term.value;
    }
    EXPECT_NEAR(sum, e.score, 1e-9 * std::abs(e.score));
  }
}

TEST(ScoreDerivation, SaysWhyAModelIsRejected) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out"));
  AssimpMeshSource source;
  const Scene scene = load_scene(folder / "scene.toml", {{"limits.height.max=0.5", "limits.parts.min=1000"}, {}});
  const Explanation e = score_derivation(scene, folder / "out/best.derivation.json", source);
  EXPECT_THAT(e.rejected, ::testing::MatchesRegex("[0-9]+ parts are below min 1000 parts, height .* m is above max "
                                                  "0.5 m"));
  EXPECT_THAT(explanation_text(e), ::testing::StartsWith("score rejected: "));
  EXPECT_THAT(explanation_text(e), HasSubstr("\nlimits: rejected x 1\n"));
  const auto json = nlohmann::json::parse(explanation_json(e));
  EXPECT_TRUE(json["score"].is_null());
  EXPECT_EQ(json["rejected"], e.rejected);
  EXPECT_TRUE(json["targets"][0]["rejected"].is_null());
  EXPECT_TRUE(json["targets"][0]["score"].is_number());
  EXPECT_TRUE(json["targets"][1]["score"].is_null());
}

TEST(ScoreDerivation, RefusesWhatIsNoDerivationOfTheGrammar) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out"));
  AssimpMeshSource source;
  const std::string whole = read_text(folder / "out/best.derivation.json");
  const auto error_of = [&](const std::string& text) -> std::string {
    write_text(folder / "d.json", text);
    try {
      score_derivation(load_scene(folder / "scene.toml"), folder / "d.json", source);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of(whole), "no error");
  EXPECT_THAT(error_of(whole.substr(0, whole.size() / 2)), HasSubstr("d.json"));
  EXPECT_THAT(error_of(""), HasSubstr("d.json"));
  EXPECT_THAT(error_of("[1, NaN]"), HasSubstr("d.json"));
}

TEST(Export, WritesEveryFormatAndIsReproducible) {
  const TemporaryFolder folder;
  write_pile(folder);
  ASSERT_TRUE(run_in(folder, "out"));
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  fs::create_directory(folder / "exports");
  for (const char* name : {"exports/m.glb", "exports/m.obj", "exports/m.ply"}) {
    export_derivation({folder / "out/alternatives/01.derivation.json", "", {}, folder / name}, source, *executor);
    const ReproduceReport report = reproduce(folder / name, "", source, *executor);
    EXPECT_TRUE(report.identical()) << name << ::testing::PrintToString(report.differences);
  }
  export_derivation({folder / "out/best.derivation.json", "", {}, folder / "exports/m.stl"}, source, *executor);
  EXPECT_THROW(reproduce(folder / "exports/m.stl", "", source, *executor), Error);
  const ExportRequest picture = {folder / "out/best.derivation.json", "", {}, folder / "exports/m.png"};
  EXPECT_THROW(export_derivation(picture, source, *executor), Error);
  export_derivation({folder / "out/best.derivation.json", folder / "pile.esp", {}, folder / "exports/n.glb"}, source,
                    *executor);
  EXPECT_EQ(fs::file_size(folder / "exports/n.glb") > 0, true);
}

}  // namespace
}  // namespace espalier
