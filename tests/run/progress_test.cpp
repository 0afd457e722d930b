#include "run/progress.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

void play(RunObserver& observer) {
  RunStart start;
  start.grammar = "pile", start.engine = "ga", start.seed = 7, start.optimum = 200, start.voxels = 1000;
  start.budget.evaluations = 1000;
  start.live = "out.partial-1/report.html", start.refresh_seconds = 5;
  observer.started(start);
  observer.warning("a mesh is open");
  for (int i = 1; i <= 100; ++i) {
    observer.step({static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(10 * i), 0.03 * i, 1.0 * i, 0.5 * i});
  }
  observer.writing();
  RunEnd end;
  end.folder = "out", end.files = {"out/best.glb"}, end.score = 100, end.optimum = 200, end.percent = 50;
  end.words = "half of it", end.steps = 100, end.evaluations = 1000, end.seconds = 3, end.stopped_by = "evaluations";
  observer.finished(end);
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Progress, LinesComeOncePerSecond) {
  std::ostringstream out;
  play(*make_lines(out));
  EXPECT_THAT(out.str(), HasSubstr("pile with ga, seed 7"));
  EXPECT_THAT(out.str(), HasSubstr("watch it in out.partial-1/report.html (refreshed every 5 s)\n"));
  EXPECT_THAT(out.str(), HasSubstr("warning: a mesh is open\n"));
  EXPECT_THAT(out.str(), HasSubstr("step 1  10 evaluations  best 1 (0.5 %)"));
  EXPECT_THAT(out.str(), HasSubstr("score 100 of at most 200 (50.0 %): half of it\n"));
  EXPECT_THAT(out.str(), HasSubstr("1000 evaluations in 100 steps and 3.0 s (333 per second), ended by evaluations\n"));
  EXPECT_THAT(out.str(), HasSubstr("wrote out/best.glb\n"));
  EXPECT_THAT(out.str(), Not(HasSubstr("\x1b")));
  EXPECT_EQ(lines_in(out.str()), 3u + 3 + 3);  // steps at 0.03, 1.05 and 2.07 s
}

TEST(Progress, TheBarRedrawsItsLineAndClearsIt) {
  std::ostringstream out;
  play(*make_bar(out));
  EXPECT_THAT(out.str(), HasSubstr("\r\x1b[K[============            ]"));
  EXPECT_EQ(lines_in(out.str()), 6u);
  EXPECT_THAT(out.str(), HasSubstr("\r\x1b[Kscore 100"));
}

TEST(Progress, JsonLinesHoldEveryStep) {
  std::ostringstream out;
  play(*make_json_lines(out));
  std::istringstream in(out.str());
  std::vector<nlohmann::json> events;
  for (std::string line; std::getline(in, line);) events.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(events.size(), 104u);
  EXPECT_EQ(events[0]["event"], "started");
  EXPECT_EQ(events[0]["budget"]["evaluations"], 1000);
  EXPECT_EQ(events[0]["live"], "out.partial-1/report.html");
  EXPECT_EQ(events[1]["message"], "a mesh is open");
  EXPECT_EQ(events[2]["event"], "step");
  EXPECT_EQ(events[51]["best"], 50.0);
  EXPECT_EQ(events[102]["event"], "writing");
  EXPECT_EQ(events[103]["percent"], 50.0);
  EXPECT_EQ(events[103]["files"][0], "out/best.glb");
}

}  // namespace
}  // namespace espalier
