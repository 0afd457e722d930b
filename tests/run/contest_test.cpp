// Plans, curves and marks of contests, by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "run/compare_summary.h"
#include "run/contest_fixtures.h"
#include "run/sweep_plan.h"

namespace espalier {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_pile;

std::string error_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Contest, ListsKeepWhatIsInBracketsAndQuotes) {
  EXPECT_THAT(split_list("1, 2,3"), ElementsAre("1", "2", "3"));
  EXPECT_THAT(split_list("[5, 15],[10,30]"), ElementsAre("[5, 15]", "[10,30]"));
  EXPECT_THAT(split_list("\"a,b\",'c,d',{x = [1,2], y = 3}"), ElementsAre("\"a,b\"", "'c,d'", "{x = [1,2], y = 3}"));
  EXPECT_THAT(split_list("\"a\\\",b\",c"), ElementsAre("\"a\\\",b\"", "c"));
  EXPECT_THAT(split_list(""), ElementsAre(""));
}

TEST(Contest, VariantsAreReadAndNamed) {
  const VariantWords words = parse_variant("published: engine=ga, search.preset = ga-2017");
  EXPECT_EQ(words.name, "published");
  EXPECT_THAT(words.settings, ElementsAre("search.engine=ga", "search.preset=ga-2017"));
  EXPECT_THAT(parse_variant("as-is:").settings, ElementsAre());
  EXPECT_THAT(error_of([] { parse_variant("no colon"); }), HasSubstr("--variant must be \"NAME: KEY=VALUE"));
  EXPECT_THAT(error_of([] { parse_variant("a/b: engine=ga"); }), HasSubstr("letters, digits"));
  EXPECT_THAT(error_of([] { parse_variant("a: engine"); }), HasSubstr("a: must be KEY=VALUE, got \"engine\""));
  EXPECT_THAT(error_of([] { parse_variant("a: engine=ga, seed=77"); }), HasSubstr("--variant a: seed: name seeds by"));
  for (const char* key : {"budget.evaluations", "budget"})
    EXPECT_THAT(error_of([&] { parse_variant(std::string("a: ") + key + "=5"); }), HasSubstr("the same for all"));
  for (const char* key : {"output.keep", "threads"})
    EXPECT_THAT(error_of([&] { parse_variant(std::string("a: ") + key + "=5"); }), HasSubstr("no search depends on"));
  EXPECT_THAT(parse_variant("a: seeds=5, budgets.x=1").settings, ElementsAre("seeds=5", "budgets.x=1"));
  EXPECT_THAT(error_of([] { parse_engines("ga,gaa"); }), HasSubstr("--engines must be of ga, smc, sosmc, rjmcmc,"));
  EXPECT_THAT(error_of([] { parse_engines(""); }), HasSubstr("got \"\""));
}

TEST(Contest, SeedsAreACountOrAList) {
  EXPECT_THAT(parse_seeds("3", 7), ElementsAre(7, 8, 9));
  EXPECT_THAT(parse_seeds("3,7,9", 1), ElementsAre(3, 7, 9));
  EXPECT_THAT(error_of([] { parse_seeds("0", 1); }), HasSubstr("--seeds must be 1 to 1000, got 0"));
  EXPECT_THAT(error_of([] { parse_seeds("3,3", 1); }), HasSubstr("names 3 twice"));
  EXPECT_THAT(error_of([] { parse_seeds("many", 1); }), HasSubstr("got \"many\""));
  EXPECT_THAT(error_of([] { parse_seeds("-1", 1); }), HasSubstr("got \"-1\""));
}

TEST(Contest, OneBudgetForAll) {
  const TemporaryFolder folder;
  write_pile(folder, testing::pile_scene("seconds = 4\nevaluations = 50\ngenerations = 7"));
  ContestWords words;
  words.scene = folder / "scene.toml";
  EXPECT_EQ(make_contest(words, parse_engines("ga,smc"), false).budget, (SceneBudget{4.0, {}, {}}));
  words.evaluations = 99;
  const Contest contest = make_contest(words, parse_engines("ga,smc"), false);
  EXPECT_EQ(contest.variants[1].scene.budget, (SceneBudget{{}, 99, {}}));
  EXPECT_EQ(contest.variants[1].scene.search.engine, EngineKind::smc);
  EXPECT_THAT(contest.seeds, ElementsAre(3, 4, 5, 6, 7));
  words.seconds = 1;
  EXPECT_THAT(error_of([&] { make_contest(words, parse_engines("ga"), false); }), HasSubstr("only one can be"));
  words.seconds = -1, words.evaluations.reset();
  EXPECT_THAT(error_of([&] { make_contest(words, parse_engines("ga"), false); }), HasSubstr("budget.seconds must be"));
  write_pile(folder);
  words.seconds.reset();
  EXPECT_THAT(error_of([&] { make_contest(words, parse_engines("ga"), false); }), HasSubstr("do not compare"));
  EXPECT_EQ(make_contest(words, parse_engines("ga"), true).budget, (SceneBudget{{}, {}, 6}));
  EXPECT_THAT(error_of([&] { make_contest(words, parse_engines("ga,ga"), true); }), HasSubstr("two variants are"));
  EXPECT_THAT(error_of([&] { make_contest(words, {{"X", {}}, {"y", {}}, {"x", {}}}, true); }),
              HasSubstr("X and x: names must differ by more than case"));
}

// The scene's seed is 3.
TEST(Contest, SeedsAreKnownBeforeTheVariants) {
  const TemporaryFolder folder;
  write_pile(folder);
  ContestWords words;
  words.scene = folder / "scene.toml", words.seeds = "2";
  EXPECT_THAT(contest_seeds(words), ElementsAre(3, 4));
  words.settings = {"seed=8"};
  EXPECT_THAT(contest_seeds(words), ElementsAre(8, 9));
  words.seed = 5;
  EXPECT_THAT(contest_seeds(words), ElementsAre(5, 6));
  words.seeds = "9,7";
  EXPECT_THAT(contest_seeds(words), ElementsAre(9, 7));
}

TEST(Contest, RisesTellTheBestAtAnyTime) {
  Rises rises;
  rises.add({1, 10, 0.5, 3, 0});
  rises.add({2, 20, 1.0, 3, 0});
  rises.add({3, 30, 2.0, 8, 0});
  rises.add({4, 45, 3.0, 8, 0});
  EXPECT_EQ(rises.at(Effort::seconds, 0.4), std::nullopt);
  EXPECT_EQ(rises.at(Effort::seconds, 0.5), 3);
  EXPECT_EQ(rises.at(Effort::seconds, 1.9), 3);
  EXPECT_EQ(rises.at(Effort::evaluations, 30), 8);
  EXPECT_EQ(rises.at(Effort::evaluations, 45), 8);
  EXPECT_EQ(rises.at(Effort::evaluations, 46), std::nullopt);
  EXPECT_EQ(rises.reaching(Effort::seconds, 3, Effort::seconds, 9), 0.5);
  EXPECT_EQ(rises.reaching(Effort::evaluations, 3.5, Effort::evaluations, 30), 30);
  EXPECT_EQ(rises.reaching(Effort::evaluations, 3.5, Effort::evaluations, 29), std::nullopt);
  EXPECT_EQ(rises.reaching(Effort::evaluations, 3.5, Effort::seconds, 2), 30);
  EXPECT_EQ(rises.reaching(Effort::evaluations, 3.5, Effort::seconds, 1.9), std::nullopt);
  EXPECT_EQ(rises.reaching(Effort::evaluations, 9, Effort::seconds, 9), std::nullopt);
}

TEST(Contest, RisesStayFewAndNear) {
  Rises rises;
  const std::uint64_t steps = 100'000;
  for (std::uint64_t i = 1; i <= steps; ++i) {
    const double size = static_cast<double>(i);
    rises.add({i, i, 1e-3 * size, size, 0});
  }
  EXPECT_EQ(rises.at(Effort::evaluations, 1), 1);
  EXPECT_EQ(rises.at(Effort::evaluations, steps), steps);
  for (const double at : {10.0, 5000.0, 77'777.0}) {
    const double best = *rises.at(Effort::evaluations, at);
    EXPECT_LE(best, at);
    EXPECT_GT(best, at - 32);
  }
}

ContestOutcome searched(std::vector<StepReport> steps, const SceneBudget& budget) {
  ContestOutcome outcome;
  for (const StepReport& step : steps) outcome.rises.add(step);
  outcome.stopped_by = "seconds";
  outcome.score = outcome.rises.at(Effort::seconds, *budget.seconds);
  outcome.evaluations = steps.back().evaluations, outcome.seconds = steps.back().seconds;
  return outcome;
}

// Two variants, two seeds, ten seconds: `a` is early, `b` is late and beats it.
TEST(Contest, MarksRanksAndReachAreThoseWorkedOutByHand) {
  const SceneBudget budget = {10.0, {}, {}};
  CompareOutcomes outcomes(2);
  outcomes[0].push_back(searched({{1, 10, 1, 50, 0}, {2, 20, 5, 60, 0}, {3, 40, 11, 99, 0}}, budget));
  outcomes[0].push_back(searched({{1, 10, 1, 54, 0}, {2, 22, 6, 62, 0}, {3, 40, 10, 70, 0}}, budget));
  outcomes[1].push_back(searched({{1, 5, 3, 20, 0}, {2, 9, 8, 80, 0}, {3, 12, 10.5, 80, 0}}, budget));
  outcomes[1].push_back(searched({{1, 5, 4, 30, 0}, {2, 9, 9, 90, 0}, {3, 12, 10.5, 90, 0}}, budget));
  const CompareSummary summary = summarise_contest(outcomes, budget, {2, 10});
  EXPECT_THAT(summary.counted, ElementsAre(0u, 1u));
  ASSERT_EQ(summary.marks.size(), 2u);
  EXPECT_EQ(summary.marks[0].scores[0].median, 52);
  EXPECT_FALSE(std::isfinite(summary.marks[0].scores[1].median)) << "no step had ended";
  EXPECT_THAT(summary.marks[0].ranking, ElementsAre(0u, 1u));
  EXPECT_EQ(summary.marks[1].scores[0].median, 65) << "99 came after ten seconds";
  EXPECT_EQ(summary.marks[1].scores[1].median, 85);
  EXPECT_THAT(summary.marks[1].ranking, ElementsAre(1u, 0u));
  EXPECT_DOUBLE_EQ(summary.marks[1].chance[0], 2.0 / 6);
  const auto& seconds = summary.reach[0];
  EXPECT_EQ(seconds[1][0].median, 8.5);    // b passed 65 after 8 and 9 s
  EXPECT_EQ(seconds[0][1].reached, 0u);    // a's 99 came after ten seconds
  EXPECT_EQ(summary.reach[1][0][1].reached, 0u);
  EXPECT_EQ(seconds[0][1].median, std::nullopt);
  EXPECT_EQ(summary.reach[1][1][0].median, 9);
  EXPECT_DOUBLE_EQ(summary.evaluations_per_second[0], 80.0 / 21);
  const CompareAxis& axis = summary.axis(Effort::seconds);
  EXPECT_EQ(axis.at.front(), 1);
  EXPECT_EQ(axis.at.back(), 10);
  EXPECT_TRUE(std::find(axis.at.begin(), axis.at.end(), 2.0) != axis.at.end()) << "marks are points";
  EXPECT_FALSE(axis.curves[1].points.front());
  EXPECT_EQ(axis.curves[1].points.back()->mean, 85);
}

// Five seeds; `first` above all, `near` mingled with it, two below all of it: p of the rank test 2/252 twice, and of
// `near` (ranks of first: 2 4 6 8 10, 30 against a mean of 27.5) much more. Holm: 3 x 2/252 for the two.
TEST(Contest, ChancesAreCorrectedForHowManyThereAre) {
  const SceneBudget budget = {10.0, {}, {}};
  CompareOutcomes outcomes(4);
  for (int seed = 0; seed < 5; ++seed) {
    const auto add = [&](std::size_t variant, double score) {
      outcomes[variant].push_back(searched({{1, 10, 1, score, 0}, {2, 20, 10, score, 0}}, budget));
    };
    add(0, 10 + seed), add(1, 102 + 2 * seed), add(2, 20 + seed), add(3, 101 + 2 * seed);
  }
  const CompareMark mark = summarise_contest(outcomes, budget, {10}).marks.back();
  EXPECT_EQ(mark.ranking.front(), 1u);
  EXPECT_DOUBLE_EQ(mark.chance[0], 3 * 2.0 / 252);
  EXPECT_EQ(mark.chance[1], 1);
  EXPECT_DOUBLE_EQ(mark.chance[2], 3 * 2.0 / 252);
  EXPECT_GT(mark.chance[3], 0.5);
  EXPECT_DOUBLE_EQ(least_chance(5, 4), 3 * 2.0 / 252);
  EXPECT_DOUBLE_EQ(least_chance(5, 2), 2.0 / 252);
  EXPECT_DOUBLE_EQ(least_chance(5, 1), 2.0 / 252);
  EXPECT_DOUBLE_EQ(least_chance(1, 8), 1);
}

// Cut short just after a mark: 0.5 s and 0.50005 s are one and the same to a reader.
TEST(Contest, ASearchCutShortHasNoMarkTwice) {
  const SceneBudget budget = {60.0, {}, {}};
  CompareOutcomes outcomes(1);
  outcomes[0].push_back(searched({{1, 10, 0.1, 50, 0}, {2, 20, 0.50005, 60, 0}}, budget));
  outcomes[0].back()->stopped_by = "interrupt";
  const CompareSummary summary = summarise_contest(outcomes, budget, {0.2, 0.5, 5, 60});
  EXPECT_TRUE(summary.partial);
  std::vector<double> at;
  for (const CompareMark& mark : summary.marks) at.push_back(mark.at);
  EXPECT_THAT(at, ElementsAre(0.2, 0.50005));
}

TEST(Contest, MarksLieWithinTheBudget) {
  EXPECT_THAT(default_marks({60.0, {}, {}}), ElementsAre(1, 5, 30, 60));
  EXPECT_THAT(default_marks({10.0, {}, {}}), ElementsAre(0.5, 1, 5, 10));
  EXPECT_THAT(default_marks({{}, 20'000, {}}), ElementsAre(1000, 3000, 10'000, 20'000));
  EXPECT_THAT(parse_marks("30,1,5,1", {60.0, {}, {}}), ElementsAre(1, 5, 30, 60));
  EXPECT_THAT(error_of([] { parse_marks("1,90", {60.0, {}, {}}); }), HasSubstr("at most the budget, 60 s, got \"90\""));
  EXPECT_THAT(error_of([] { parse_marks("", {60.0, {}, {}}); }), HasSubstr("got \"\""));
  EXPECT_THAT(error_of([] { parse_marks("nan", {60.0, {}, {}}); }), HasSubstr("got \"nan\""));
}

TEST(SweepPlan, AllCombinationsOrSomeOfThem) {
  const auto varied = parse_varied({"search.population=10,50", "search.first=roulette,tournament,random"});
  const auto all = plan_combinations(varied, std::nullopt, 1);
  EXPECT_THAT(all, ElementsAre(ElementsAre(0, 0), ElementsAre(0, 1), ElementsAre(0, 2), ElementsAre(1, 0),
                               ElementsAre(1, 1), ElementsAre(1, 2)));
  EXPECT_EQ(plan_combinations(varied, 6, 1), all);
  EXPECT_EQ(plan_combinations(varied, 60, 1), all);
  const auto some = plan_combinations(varied, 3, 1);
  EXPECT_EQ(some.size(), 3u);
  EXPECT_EQ(some, plan_combinations(varied, 3, 1));
  EXPECT_EQ(sweep_variants(varied, all, "ga")[5].name, "search.population=50, search.first=random");
  EXPECT_THAT(sweep_variants(varied, all, "ga")[5].settings,
              ElementsAre("search.engine=\"ga\"", "search.population=50", "search.first=random"));
}

TEST(SweepPlan, BadListsAreNamed) {
  const auto error = [](std::vector<std::string> texts) { return error_of([&] { parse_varied(texts); }); };
  EXPECT_THAT(error({"search.population"}), HasSubstr("--vary must be KEY=VALUE,VALUE"));
  EXPECT_THAT(error({"search.population="}), HasSubstr("a value is empty"));
  EXPECT_THAT(error({"search.population=1,,2"}), HasSubstr("a value is empty"));
  EXPECT_THAT(error({"a=1,2,1"}), HasSubstr("1 is there twice"));
  EXPECT_THAT(error({"a=1", "a=2"}), HasSubstr("--vary a is there twice"));
  EXPECT_THAT(error({"seed=1,2"}), HasSubstr("--seeds"));
  EXPECT_THAT(error({"budget.seconds=1,2"}), HasSubstr("--time"));
  EXPECT_THAT(error({"output.keep=1,2"}), HasSubstr("no search depends on it"));
  std::string hundred = "0";
  for (int i = 1; i < 100; ++i) hundred += "," + std::to_string(i);
  const auto many = parse_varied({"a=" + hundred, "b=" + hundred});
  EXPECT_THAT(error_of([&] { plan_combinations(many, std::nullopt, 1); }), HasSubstr("10000 combinations"));
  EXPECT_EQ(plan_combinations(many, 20, 1).size(), 20u);
}

}  // namespace
}  // namespace espalier
