// espalier compare and sweep from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cmd/program_test.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ChildOptions;
using testing::ChildResult;
using testing::read_text;
using testing::write_pile;
using testing::write_text;

namespace fs = std::filesystem;

class ContestCmd : public testing::ProgramTest {
 protected:
  ContestCmd() { write_pile(folder_); }
};

TEST_F(ContestCmd, CompareTellsWhoIsAhead) {
  const ChildResult result = espalier({"compare", "scene.toml", "--engines", "ga,rjmcmc", "--variant",
                                       "small: search.population=12", "--seeds", "2", "--evaluations", "300", "--marks",
                                       "100", "--threads", "1", "--out", "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("pile: 3 variants, seeds 3 to 4, 300 evaluations each with 1 thread"),
                                HasSubstr("\nafter  variant"), HasSubstr("\n100    "), HasSubstr("\n300    "),
                                HasSubstr("2 seeds are too few to tell it from chance"),
                                HasSubstr("until it passed the last median of"), HasSubstr("wrote out/compare.html")));
  EXPECT_THAT(read_text(folder_ / "out/compare.html"), HasSubstr("espalier compare scene.toml --engines ga,rjmcmc"));
  const ChildResult run = espalier({"run", "out/small.toml", "--generations", "3", "--out", "again"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  // The same folder again, but never over other files.
  EXPECT_EQ(espalier({"compare", "scene.toml", "--engines", "ga", "--evaluations", "50", "--out", "out"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/small.toml"));
  write_text(folder_ / "other/mine.txt", "mine");
  const ChildResult taken =
      espalier({"compare", "scene.toml", "--engines", "ga", "--evaluations", "50", "--out", "other"});
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_THAT(taken.err, HasSubstr("holds other files"));
}

TEST_F(ContestCmd, EventsAreJson) {
  const ChildResult result = espalier({"compare", "scene.toml", "--engines", "ga,sosmc", "--seeds", "3,9",
                                       "--evaluations", "200", "--json", "--out", "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  std::vector<std::string> events;
  nlohmann::json last;
  for (std::string line; std::getline(lines, line);) events.push_back((last = nlohmann::json::parse(line))["event"]);
  EXPECT_EQ(events.front(), "started");
  EXPECT_EQ(std::count(events.begin(), events.end(), "ended"), 4);
  EXPECT_EQ(last["event"], "finished");
  EXPECT_EQ(last["result"]["seeds"], (std::vector<int>{3, 9}));
}

TEST_F(ContestCmd, CtrlCEndsWithWhatIsThere) {
  ChildOptions options;
  options.interrupt_when = "\"turn\"";
  const ChildResult result = espalier({"compare", "scene.toml", "--engines", "ga,rjmcmc", "--seeds", "3", "--time",
                                       "60", "--json", "--out", "out"}, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_text(folder_ / "out/searches.csv"), HasSubstr(",interrupt\n"));
}

TEST_F(ContestCmd, SweepTellsWhatMatters) {
  const ChildResult result = espalier({"sweep", "scene.toml", "--vary", "search.population=8,24", "--vary",
                                       "search.first=roulette,tournament", "--seeds", "2", "--generations", "4",
                                       "--set", "search.elitism=2", "--curves", "--out", "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("rank  population"), HasSubstr("\nbest  "), HasSubstr("search.first, "),
                                HasSubstr("wrote out/best.toml")));
  EXPECT_TRUE(fs::exists(folder_ / "out/curves.csv"));
  const ChildResult best = espalier({"run", "out/best.toml", "--out", "best"});
  EXPECT_EQ(best.exit_code, 0) << best.err;
}

// The pile's seed is 3: the same combinations are drawn where it is given by hand, and by --seeds.
TEST_F(ContestCmd, SweepsDrawByTheFirstSeed) {
  const auto drawn = [&](std::vector<std::string> seeds) {
    std::vector<std::string> words = {"sweep", "scene.toml", "--vary", "search.population=8,9,10,11,12,13,14,15",
                                      "--vary", "search.elitism=0,1,2,3", "--random", "2", "--generations", "1",
                                      "--out", "out"};
    words.insert(words.end(), seeds.begin(), seeds.end());
    const ChildResult result = espalier(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::vector<std::string> combinations;
    const auto json = nlohmann::json::parse(read_text(folder_ / "out/sweep.json"));
    for (const auto& combination : json["ranking"]) combinations.push_back(combination["values"].dump());
    std::sort(combinations.begin(), combinations.end());
    return combinations;
  };
  const std::vector<std::string> of_scene = drawn({"--seeds", "1"});
  EXPECT_EQ(of_scene.size(), 2u);
  EXPECT_EQ(of_scene, drawn({"--seeds", "1", "--seed", "3"}));
  EXPECT_EQ(of_scene, drawn({"--seeds", "3,9"}));
  EXPECT_NE(of_scene, drawn({"--seeds", "1", "--seed", "1"}));
}

TEST_F(ContestCmd, BadInputIsTold) {
  const auto told = [&](std::vector<std::string> arguments, const std::string& words) {
    const ChildResult result = espalier(arguments);
    EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(arguments);
    EXPECT_THAT(result.err, HasSubstr(words));
  };
  told({"compare", "scene.toml", "--engines", "ga,dance"}, "--engines must be of ga, smc");
  told({"compare", "scene.toml", "--engines", ",", "--time", "1"}, "got \"\"");
  told({"compare", "scene.toml", "--seeds", "0", "--time", "1"}, "--seeds must be 1 to 1000, got 0");
  told({"compare", "scene.toml"}, "do not compare");
  for (const char* option : {"--engines", "--marks", "--seeds", "--clock", "--out", "--variant"})
    told({"compare", "scene.toml", "--evaluations", "9", option, ""}, std::string(option) + ": must not be empty");
  told({"compare", "scene.toml", "--evaluations", "9", "--seed", ""}, "--seed: ");
  told({"sweep", "scene.toml", "--vary", "search.mutation=0,1", "--engine", ""}, "--engine: must not be empty");
  told({"compare", "scene.toml", "--evaluations", "9", "--variant", "x: seed=7"}, "--variant x: seed: ");
  told({"compare", "none.toml", "--time", "1"}, "none.toml");
  told({"compare", "scene.toml", "--time", "1", "--evaluations", "9"}, "only one can be the budget");
  told({"compare", "scene.toml", "--time", "1", "--variant", "x: search.dance=1"}, "x: scene.toml");
  told({"sweep", "scene.toml"}, "--vary");
  told({"sweep", "scene.toml", "--vary", "search.dance=1,2"}, "search.dance=1: scene.toml");
  told({"sweep", "scene.toml", "--vary", "search.population=9,1"}, "search.population=1: ");
  told({"sweep", "scene.toml", "--vary", "search.population="}, "a value is empty");
  told({"sweep", "scene.toml", "--vary", "search.mutation=0,1", "--engine", "dance"}, "search.engine must be one of");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace espalier
