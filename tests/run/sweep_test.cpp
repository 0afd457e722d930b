#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/contest_fixtures.h"
#include "run/reproduce.h"
#include "run/run_folders.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::pile_sweep;
using testing::pile_words;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_pile;

namespace fs = std::filesystem;

class Sweep : public ::testing::Test {
 protected:
  Sweep() { write_pile(folder_); }
  SweepResult sweep(const SweepRequest& request) {
    std::optional<SweepResult> result = sweep_settings(request, source_);
    EXPECT_TRUE(result);
    return std::move(*result);
  }
  std::string error_of(const std::vector<std::string>& varied, const std::string& seeds = "2") {
    ContestWords words = pile_words(folder_);
    words.seeds = seeds;
    try {
      pile_sweep(folder_, "out", varied, words);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
  AssimpMeshSource source_;
};

TEST_F(Sweep, EveryCombinationIsSearchedAndRanked) {
  SweepRequest request =
      pile_sweep(folder_, "out", {"search.population=8,40", "search.mutation=0.1,0.9,1.0"}, pile_words(folder_, 400));
  request.curves = true;
  const SweepResult result = sweep(request);
  ASSERT_EQ(result.combinations.size(), 6u);
  for (std::size_t rank = 1; rank < 6; ++rank) {
    EXPECT_GE(result.combinations[result.ranking[rank - 1]].scores->median,
              result.combinations[result.ranking[rank]].scores->median);
  }
  ASSERT_EQ(result.effects.size(), 2u);
  std::vector<double> eights;
  for (std::size_t i = 0; i < 3; ++i) eights.push_back(result.combinations[i].scores->median);
  EXPECT_EQ(result.effects[0][0].medians->median, summarise(eights).median);
  EXPECT_EQ(result.effects[1][0].medians->count, 2u);

  const std::string rows = read_text(folder_ / "out/sweep.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 12);
  EXPECT_THAT(rows, AllOf(::testing::StartsWith("combination,seed,search.population,search.mutation,score,share,"),
                          HasSubstr("\n6,4,40,1.0,")));
  EXPECT_THAT(read_text(folder_ / "out/effects.csv"), HasSubstr("\nsearch.mutation,0.9,2,"));
  const std::string curves = read_text(folder_ / "out/curves.csv");
  EXPECT_THAT(curves, AllOf(HasSubstr("\n1,8,0.1,1,2,8,"), HasSubstr("\n6,40,1.0,3,2,")));
  const auto json = nlohmann::json::parse(read_text(folder_ / "out/sweep.json"));
  EXPECT_EQ(json["ranking"][0]["combination"], result.ranking[0] + 1);
  EXPECT_EQ(json["machine"], nlohmann::json::parse(json_of(this_machine()).dump()));
}

TEST_F(Sweep, TheSceneOfTheBestIsReadyToRun) {
  const SweepResult result =
      sweep(pile_sweep(folder_, "out", {"search.initial_length=[5,15],[2,3]"}, pile_words(folder_, 300)));
  const std::string best = read_text(folder_ / "out/best.toml");
  EXPECT_THAT(best, HasSubstr(result.ranking[0] == 0 ? "initial_length = [5, 15]" : "initial_length = [2, 3]"));
  const Scene scene = load_scene(folder_ / "out/best.toml", {{"budget={generations = 2}"}, {}});
  EXPECT_TRUE(run_scene(scene, {folder_ / "again", nullptr, nullptr}, source_));
  EXPECT_TRUE(reproduce(folder_ / "out/best.glb", "", source_, *make_serial_executor()).identical());
}

// More combinations than search at once, so that they are made ready anew for every seed.
TEST_F(Sweep, GroupsChangeNothing) {
  std::vector<std::string> values = {"search.population=8,9,10,11,12,13,14,15,16,17"};
  const SweepResult many = sweep(pile_sweep(folder_, "many", values, pile_words(folder_, 100)));
  const SweepResult one = sweep(pile_sweep(folder_, "one", {"search.population=17"}, pile_words(folder_, 100)));
  for (std::size_t seed = 0; seed < 2; ++seed)
    EXPECT_EQ(many.combinations[9].searches[seed]->derivation, one.combinations[0].searches[seed]->derivation);
  SweepRequest threads = pile_sweep(folder_, "threads", values, pile_words(folder_, 100));
  threads.threads = 2;
  const SweepResult two = sweep(threads);
  EXPECT_EQ(two.ranking, many.ranking);
  EXPECT_EQ(read_text(folder_ / "threads/best.glb"), read_text(folder_ / "many/best.glb"));
}

// A pile of 90 parts of 8 genes there is not. Both orders: the first search that ends is not what decides.
TEST_F(Sweep, AValueThatCannotBeCostsNoOther) {
  for (const char* values : {"limits.parts.min=90,1", "limits.parts.min=1,90"}) {
    const bool bad_first = std::string(values).ends_with(",1");
    ContestWords words = pile_words(folder_, 150);
    words.settings.emplace_back("limits.genes.max=8");
    SweepRequest request = pile_sweep(folder_, "out", {values, "search.mutation=0.1,0.9"}, words);
    request.curves = true;
    const SweepResult result = sweep(request);
    EXPECT_EQ(result.failed, 4u);
    EXPECT_EQ(result.ranking[0] / 2, bad_first ? 1u : 0u);
    const std::size_t bad = bad_first ? 0 : 1;
    EXPECT_EQ(result.effects[0][bad].medians->median, kNotAcceptable);
    EXPECT_EQ(result.effects[0][bad].nothing, 2u);
    EXPECT_EQ(result.effects[0][1 - bad].nothing, 0u);
    EXPECT_EQ(effect_of(result.effects[0]), std::nullopt) << "nothing is no distance apart";
    // With either mutation one of two combinations came to nothing: no survivor speaks for it.
    EXPECT_EQ(result.effects[1][0].nothing, 1u);
    EXPECT_EQ(result.effects[1][0].medians->count, 2u);
    EXPECT_FALSE(std::isfinite(result.effects[1][0].medians->median));
    EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("2 of 2 searches came to nothing; seed 3: none of ")));
    EXPECT_THAT(read_text(folder_ / "out/effects.csv"), HasSubstr("\nlimits.parts.min,90,2,,,,,,,2\n"));
    const auto json = nlohmann::json::parse(read_text(folder_ / "out/sweep.json"));
    EXPECT_TRUE(json["effects"]["limits.parts.min"].is_null());
    EXPECT_EQ(json["searches_failed"], 4);
    EXPECT_THAT(read_text(folder_ / "out/sweep.html"), HasSubstr("(2 came to nothing)"));
  }
}

TEST_F(Sweep, AVariantThatCannotBeMadeReadyCostsNoOther) {
  testing::write_text(folder_ / "broken.esp", "this is no grammar");
  const SweepResult result =
      sweep(pile_sweep(folder_, "out", {"grammar=broken.esp,pile.esp"}, pile_words(folder_, 100)));
  EXPECT_EQ(result.failed, 2u);
  EXPECT_EQ(result.ranking[0], 1u);
  EXPECT_EQ(result.grammar, "pile");
}

// Three searches of one combination, of which one failed: the others do not make its curve.
TEST(SweepCurve, HasNoPointsWhereASearchFailed) {
  SweepResult result;
  ContestOutcome found, failed;
  found.steps = {{1, 10, 0.5, 3, 2}, {2, 20, 1.0, 5, 4}};
  failed.problem = "why";
  result.combinations = {{{found, found}, {}, 1}, {{found, failed}, {}, 1}};
  const auto curve = [&](std::size_t combination) {
    return sweep_curve(result, combination, {1, 2}, [](const StepReport& r) { return static_cast<double>(r.step); },
                       [](const StepReport& r) { return r.best; });
  };
  ASSERT_TRUE(curve(0).points[1]);
  EXPECT_EQ(curve(0).points[1]->mean, 5);
  EXPECT_FALSE(curve(1).points[0]);
  EXPECT_FALSE(curve(1).points[1]);
}

TEST_F(Sweep, BadInputNamesTheCombination) {
  EXPECT_THAT(error_of({"search.population=10,-5"}),
              AllOf(HasSubstr("search.population=-5: "), HasSubstr("search.population must be a whole number")));
  EXPECT_THAT(error_of({"search.populatoin=10,20"}), HasSubstr("did you mean search.population?"));
  EXPECT_THAT(error_of({"search.population=3,40", "search.elitism=1,9"}),
              HasSubstr("search.population=3, search.elitism=9: "));
  EXPECT_THAT(error_of({"engine.rjmcmc.chains=1,2"}), HasSubstr("changes nothing, the engine is ga"));
  EXPECT_THAT(error_of({"search.population=5,6"}, "900"), HasSubstr("2 combinations x 900 seeds = 1800"));
  EXPECT_EQ(error_of({"search.engine=ga,rjmcmc", "engine.rjmcmc.chains=4,8"}), "");
}

}  // namespace
}  // namespace espalier
