// Comparisons: fair budgets, the same results as separate runs, files that make the best again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/contest_fixtures.h"
#include "run/reproduce.h"
#include "run/run_folders.h"
#include "run/search_loop.h"
#include "run/model_files.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::lines_with;
using testing::pile_comparison;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_pile;

namespace fs = std::filesystem;

class Compare : public ::testing::Test {
 protected:
  Compare() { write_pile(folder_); }
  CompareResult compare(const CompareRequest& request) {
    std::optional<CompareResult> result = compare_variants(request, source_);
    EXPECT_TRUE(result);
    return std::move(*result);
  }
  TemporaryFolder folder_;
  AssimpMeshSource source_;
};

TEST_F(Compare, SameResultsForAnyNumberOfThreadsAndTurns) {
  CompareRequest request = pile_comparison(folder_, "turns", parse_engines("ga,smc,sosmc,rjmcmc,hybrid"));
  request.slice_seconds = 0;  // a step a turn
  const CompareResult turns = compare(request);
  request.slice_seconds = 1e9, request.threads = 2, request.out = folder_ / "one";
  compare(request);
  for (const char* name : {"compare.csv", "reach.csv"}) {
    const std::string one = read_text(folder_ / ("one/" + std::string(name)));
    EXPECT_EQ(lines_with(read_text(folder_ / ("turns/" + std::string(name))), ",evaluations,"),
              lines_with(one, ",evaluations,")) << name;
    EXPECT_GT(lines_with(one, ",evaluations,").size(), 200u);
  }
  for (const char* name : {"ga", "smc", "sosmc", "rjmcmc", "hybrid"}) {
    for (const char* ending : {".best.derivation.json", ".best.glb", ".png", ".toml"}) {
      const std::string file = std::string(name) + ending;
      EXPECT_EQ(read_text(folder_ / ("turns/" + file)), read_text(folder_ / ("one/" + file))) << file;
      EXPECT_FALSE(read_text(folder_ / ("one/" + file)).empty()) << file;
    }
  }
  for (std::size_t v = 0; v < 5; ++v) {
    const ContestOutcome& outcome = *turns.outcomes[v][0];
    EXPECT_GE(outcome.evaluations, 700u);
    EXPECT_EQ(outcome.stopped_by, "evaluations");
  }
}

TEST_F(Compare, EachSearchIsWhatARunFinds) {
  const CompareResult result = compare(pile_comparison(folder_, "out", parse_engines("ga,sosmc,rjmcmc,hybrid")));
  const std::unique_ptr<Executor> executor = make_tbb_executor(2);
  for (std::size_t v = 0; v < result.outcomes.size(); ++v) {
    for (const std::optional<ContestOutcome>& outcome : result.outcomes[v]) {
      SceneOverrides overrides = {{testing::kSmallEngines, std::end(testing::kSmallEngines)}, {}};
      const std::string engine = std::vector<std::string>{"ga", "sosmc", "rjmcmc", "hybrid"}[v];
      overrides.settings.insert(overrides.settings.end(),
                                {"search.engine=" + engine, "seed=" + std::to_string(outcome->seed)});
      const std::unique_ptr<espalier::Setup> setup = set_up(load_scene(folder_ / "scene.toml", overrides), source_);
      SearchControl control;
      control.budget.evaluations = 700;
      const std::optional<SearchResult> run = run_search(*setup, control, *executor);
      EXPECT_EQ(run->best.derivation, result.bests[v]->seed == outcome->seed ? result.bests[v]->individual.derivation
                                                                              : run->best.derivation);
      EXPECT_EQ(hash_text(run->best.derivation), outcome->derivation) << engine;
      EXPECT_EQ(run->best.score, outcome->best.score);
      EXPECT_EQ(run->steps, outcome->step_count);
      EXPECT_EQ(run->evaluations, outcome->evaluations);
    }
  }
}

TEST_F(Compare, SettingsMakeTheBestAgain) {
  std::vector<VariantWords> variants = parse_engines("rjmcmc");
  variants.push_back(parse_variant("small: engine=ga, search.population=12, search.initial_length=[4, 9]"));
  const CompareResult result = compare(pile_comparison(folder_, "out", variants));
  for (std::size_t v = 0; v < 2; ++v) {
    const std::string name = variants[v].name;
    AssimpMeshSource source;
    Scene scene = load_scene(folder_ / ("out/" + name + ".toml"),
                             {{"seed=" + std::to_string(result.bests[v]->seed),
                               "budget={generations = " + std::to_string(result.bests[v]->steps) + "}"}, {}});
    ASSERT_TRUE(run_scene(scene, {folder_ / "again", nullptr, nullptr}, source));
    const auto again = nlohmann::json::parse(read_text(folder_ / "again/best.derivation.json"));
    const auto best = nlohmann::json::parse(read_text(folder_ / ("out/" + name + ".best.derivation.json")));
    EXPECT_EQ(again["genes"], best["genes"]) << name;
    for (const char* ending : {".best.derivation.json", ".best.glb", ".png"}) {
      const ReproduceReport report =
          reproduce(folder_ / ("out/" + name + ending), "", source, *make_serial_executor());
      EXPECT_TRUE(report.identical()) << name << ending << ::testing::PrintToString(report.differences);
    }
  }
  EXPECT_THAT(read_text(folder_ / "out/small.toml"), HasSubstr("population = 12"));
  EXPECT_TRUE(fs::exists(folder_ / "out/inputs/pile.esp"));
}

TEST_F(Compare, FilesHoldWhatTheyPromise) {
  const CompareResult result = compare(pile_comparison(folder_, "out", parse_engines("ga,rjmcmc")));
  const std::string curves = read_text(folder_ / "out/compare.csv");
  EXPECT_THAT(curves, ::testing::StartsWith("engine,seed,axis,at,best,share\nga,3,evaluations,24,"));
  EXPECT_THAT(curves, AllOf(HasSubstr("rjmcmc,4,evaluations,700,"), HasSubstr("ga,4,seconds,")));
  EXPECT_THAT(read_text(folder_ / "out/summary.csv"), HasSubstr("ga,evaluations,700,"));
  EXPECT_THAT(read_text(folder_ / "out/searches.csv"), HasSubstr(",evaluations\n"));
  const auto json = nlohmann::json::parse(read_text(folder_ / "out/compare.json"));
  EXPECT_EQ(json["seeds_counted"], (std::vector<int>{3, 4}));
  EXPECT_EQ(json["marks"].back()["evaluations"], 700);
  EXPECT_EQ(json["machine"], nlohmann::json::parse(json_of(this_machine()).dump()));
  EXPECT_FALSE(json["cut_short"]);
  EXPECT_EQ(json["marks"].back()["variants"]["ga"]["median"], result.summary.marks.back().scores[0].median);
  // A curve never falls, and its last point is the score.
  for (const CompareCurve& curve : result.summary.axis(Effort::evaluations).curves) {
    for (const auto& search : curve.searches) {
      double last = -1e300;
      for (const std::optional<double>& point : search) {
        if (!point) continue;
        EXPECT_GE(*point, last);
        last = *point;
      }
    }
    EXPECT_TRUE(curve.points.back());
  }
}

TEST_F(Compare, StoppedByHandItEndsWithWhatIsThere) {
  std::atomic<bool> stop{false};
  struct Stopper : ContestObserver {
    explicit Stopper(std::atomic<bool>& flag) : stop(flag) {}
    void turn(const ContestTurn& turn) override {
      if (turn.seed == 4) stop = true;
    }
    std::atomic<bool>& stop;
  } stopper(stop);
  CompareRequest request = pile_comparison(folder_, "out", parse_engines("ga,rjmcmc"));
  request.slice_seconds = 0, request.stop = &stop, request.observer = &stopper;
  const CompareResult result = compare(request);
  EXPECT_TRUE(result.interrupted);
  EXPECT_THAT(result.summary.counted, ElementsAre(0u));
  EXPECT_FALSE(result.summary.partial);
  EXPECT_EQ(result.outcomes[0][1]->stopped_by, "interrupt");
  EXPECT_FALSE(result.outcomes[1][1]) << "had not begun";
  EXPECT_THAT(read_text(folder_ / "out/searches.csv"), HasSubstr(",interrupt\n"));
  EXPECT_THAT(read_text(folder_ / "out/compare.html"),
              AllOf(HasSubstr("stopped by hand, 2 seeds planned"),
                    HasSubstr("Interrupted: stopped by hand: these are of the 1 of 2 seeds that all")));

  stop = true;
  request.out = folder_ / "none";
  EXPECT_FALSE(compare_variants(request, source_));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(Compare, StoppedInItsFirstSeedItTellsOfThatMuch) {
  std::atomic<bool> stop{false};
  struct Stopper : ContestObserver {
    explicit Stopper(std::atomic<bool>& flag) : stop(flag) {}
    void turn(const ContestTurn& turn) override {
      if (turn.report.evaluations > 500) stop = true;
    }
    std::atomic<bool>& stop;
  } stopper(stop);
  CompareRequest request = pile_comparison(folder_, "out", parse_engines("ga,rjmcmc"), 100'000);
  request.slice_seconds = 0, request.stop = &stop, request.observer = &stopper;
  const CompareResult result = compare(request);
  EXPECT_TRUE(result.summary.partial);
  EXPECT_LT(result.summary.marks.back().at, 1000) << "as far as both came, not the budget";
  EXPECT_THAT(interruption_in_words(request.contest, result),
              HasSubstr("no seed was completed: these are of seed 3, cut short after "));
  EXPECT_THAT(read_text(folder_ / "out/compare.html"),
              AllOf(HasSubstr("stopped by hand before any seed was done"), HasSubstr("Interrupted: no seed was")));
  EXPECT_TRUE(nlohmann::json::parse(read_text(folder_ / "out/compare.json"))["cut_short"]);
}

TEST_F(Compare, ASearchThatFailsIsToldAndCostsNoOther) {
  // smc's weights by ratio need scores above 0, which the first models of the pile do not have with such an overlap.
  testing::write_text(folder_ / "scene.toml", testing::pile_scene("generations = 6"));
  std::vector<VariantWords> variants = parse_engines("ga");
  variants.push_back(parse_variant("ratio: engine=smc, search.weight=ratio, volume.outside_weight=1000"));
  CompareRequest request = pile_comparison(folder_, "out", variants);
  request.slice_seconds = 0;  // ratio fails before ga is done
  const CompareResult result = compare(request);
  EXPECT_FALSE(result.outcomes[1][0]->problem.empty());
  EXPECT_FALSE(result.bests[1]);
  EXPECT_EQ(result.failed, 2u);
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("ratio has other targets or limits than ga"),
                                           HasSubstr("ratio: 2 of 2 searches came to nothing; seed 3: ")));
  EXPECT_EQ(nlohmann::json::parse(read_text(folder_ / "out/compare.json"))["searches_failed"], 2);
  EXPECT_EQ(result.summary.marks.back().ranking, (std::vector<std::size_t>{0, 1}));
  EXPECT_FALSE(fs::exists(folder_ / "out/ratio.toml"));
}

TEST_F(Compare, WhereNothingCameOfAnySearchItSaysWhy) {
  const CompareRequest request = pile_comparison(
      folder_, "out", {parse_variant("one: engine=ga, limits.parts.min=90, limits.parts.max=90, limits.genes.max=8"),
                       parse_variant("two: engine=smc, search.weight=ratio, volume.outside_weight=1000")});
  try {
    compare_variants(request, source_);
    ADD_FAILURE() << "nothing to tell of";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("one, seed 3: none of "));
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace espalier
