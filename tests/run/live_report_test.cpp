#include "run/live_report.h"

#include <chrono>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cmd/child.h"
#include "io/mesh_import.h"
#include "io/png.h"
#include "run/fixtures.h"
#include "run/report_page.h"
#include "run/run.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::element_text;
using testing::pile_scene;
using testing::read_text;
using testing::read_tree;
using testing::TemporaryFolder;
using testing::write_pile;

namespace fs = std::filesystem;

void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

class Watching final : public RunObserver {
 public:
  void started(const RunStart& start) override { live = start.live; }
  void step(const StepReport& report) override {
    if (on_step) on_step(report);
  }
  void warning(const std::string& text) override { warnings.push_back(text); }
  std::string live;
  std::vector<std::string> warnings;
  std::function<void(const StepReport&)> on_step;
};

bool run_in(const TemporaryFolder& folder, const std::string& out, double refresh_seconds, Watching& observer,
            const std::atomic<bool>* stop = nullptr) {
  AssimpMeshSource source;
  Scene scene = load_scene(folder / "scene.toml");
  scene.refresh_seconds = refresh_seconds;
  return run_scene(scene, {folder / out, stop, &observer}, source);
}

TEST(LiveReport, CanBeOpenedWhileTheSearchGoesOn) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene("generations = 10000"));
  std::atomic<bool> stop{false};
  Watching observer;
  std::string page, picture;
  std::uint64_t refreshes = 0;
  observer.on_step = [&](const StepReport&) {
    wait_a_little();
    if (!fs::exists(observer.live)) return;
    const std::string now = read_text(observer.live);
    refreshes += now != page;
    page = now;
    picture = read_text((fs::path(observer.live).parent_path() / "best.png").string());
    stop = refreshes == 3;
  };
  ASSERT_TRUE(run_in(folder, "out", 0.01, observer, &stop));
  EXPECT_EQ(refreshes, 3u);
  EXPECT_THAT(observer.live, HasSubstr("/out.partial-"));
  EXPECT_TRUE(observer.live.ends_with("/report.html"));
  EXPECT_TRUE(picture.starts_with(kPngSignature));
  testing::expect_well_formed(page);
  const auto data = nlohmann::json::parse(element_text(page, "data"));
  EXPECT_EQ(data["live"]["final"], "../out/");
  EXPECT_EQ(data["live"]["refresh"], 0.01);
  EXPECT_GT(data["best"].size(), 2u);
  EXPECT_GT(data["model"]["triangles"], 0);
  EXPECT_THAT(page, HasSubstr("<noscript><meta http-equiv=\"refresh\" content=\"1\"></noscript>"));
  EXPECT_TRUE(observer.warnings.empty()) << observer.warnings[0];
  // Now the folder has its name, and the page no longer waits.
  EXPECT_FALSE(fs::exists(observer.live));
  const std::string last = read_text(folder / "out/report.html");
  EXPECT_TRUE(nlohmann::json::parse(element_text(last, "data"))["live"].is_null());
  EXPECT_EQ(last.find("http-equiv=\"refresh\""), std::string::npos);
}

TEST(LiveReport, ChangesNoResult) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene("generations = 60"));
  Watching observer, silent;
  bool seen = false;
  observer.on_step = [&](const StepReport&) { wait_a_little(), seen |= fs::exists(observer.live); };
  ASSERT_TRUE(run_in(folder, "with", 0.001, observer));
  ASSERT_TRUE(run_in(folder, "without", 0, silent));
  EXPECT_TRUE(seen);
  EXPECT_EQ(silent.live, "");
  auto with = read_tree(folder / "with"), without = read_tree(folder / "without");
  for (auto* files : {&with, &without}) {
    (*files)["report.html"] = testing::without_report_times((*files)["report.html"]);
    files->erase("result.json"), files->erase("convergence.csv"), files->erase("diagnostics.csv");
  }
  EXPECT_EQ(with, without);
}

TEST(LiveReport, NoneWhenItIsNotWanted) {
  const TemporaryFolder folder;
  write_pile(folder);
  Watching observer;
  observer.on_step = [&](const StepReport&) { EXPECT_EQ(read_tree(folder.path()).size(), 3u); };
  ASSERT_TRUE(run_in(folder, "out", 0, observer));
  EXPECT_EQ(observer.live, "");
}

TEST(LiveReport, WhatCannotBeWrittenIsTold) {
  const TemporaryFolder folder;
  write_pile(folder);
  AssimpMeshSource source;
  const auto setup = set_up(load_scene(folder / "scene.toml"), source);
  Watching observer;
  SearchControl control;
  control.budget.generations = 1;
  const auto executor = make_serial_executor();
  const auto result = run_search(*setup, control, *executor);
  LiveReport live(*setup, "", folder / "nowhere", folder / "out", 0.001);
  live.stepped({1, 10, 5.0, 1, 1}, result->best);
  for (int i = 2; i < 500; ++i) wait_a_little(), live.stepped({static_cast<std::uint64_t>(i), 20, 5.0 + i, 1, 1}, result->best);
  EXPECT_THAT(live.end(), HasSubstr("nowhere/best.png"));
}

TEST(LiveReport, AnEarlierRunOutlivesOneThatIsKilled) {
  const TemporaryFolder folder;
  write_pile(folder);
  Watching observer;
  ASSERT_TRUE(run_in(folder, "out", 0, observer));
  const auto before = read_tree(folder / "out");
  testing::ChildOptions options;
  options.folder = folder.path();
  const pid_t child = testing::start_child({"run", "scene.toml", "--out", "out", "--json", "--time", "1000", "--set",
                                            "output.refresh_seconds=0.05"},
                                           options, folder / "stdout", folder / "stderr");
  std::string live;
  for (int i = 0; i < 20000 && (live.empty() || !fs::exists(folder / live)); ++i) {
    wait_a_little();
    const std::string out = read_text(folder / "stdout");
    if (live.empty() && out.find('\n') != std::string::npos) {
      live = nlohmann::json::parse(out.substr(0, out.find('\n')))["live"];
    }
  }
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_FALSE(live.empty()) << read_text(folder / "stderr");
  EXPECT_TRUE(fs::exists(folder / live)) << live;
  EXPECT_EQ(read_tree(folder / "out"), before);
}

}  // namespace
}  // namespace espalier
