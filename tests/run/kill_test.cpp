// kill -9, again and again, at moments that nobody chose: in the end the folder of a run that was never stopped.
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "cmd/child.h"
#include "run/resume_runs.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::partial_folders;
using testing::read_text;
using testing::TemporaryFolder;

namespace fs = std::filesystem;

void wait_a_little() { std::this_thread::sleep_for(std::chrono::microseconds(300)); }

/// A process of the program in a folder; killed at the end of the scope if it still lives.
class Running {
 public:
  Running(const TemporaryFolder& folder, std::vector<std::string> arguments, const std::string& name)
      : out_(folder / (name + ".stdout")), err_(folder / (name + ".stderr")) {
    testing::ChildOptions options;
    options.folder = folder.path();
    child_ = testing::start_child(arguments, options, out_, err_);
  }
  ~Running() { kill_now(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  bool lives() {
    if (child_ > 0 && waitpid(child_, &status_, WNOHANG) == child_) child_ = 0;
    return child_ > 0;
  }
  void kill_now() {
    if (!lives()) return;
    kill(child_, SIGKILL);
    waitpid(child_, &status_, 0);
    child_ = 0;
  }
  bool done() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }
  std::string out() const { return read_text(out_); }
  std::string err() const { return read_text(err_); }

 private:
  std::string out_, err_;
  pid_t child_ = 0;
  int status_ = 0;
};

/// The checkpoint of the one folder that is not finished; 0: there is none.
ino_t checkpoint_file(const TemporaryFolder& folder) {
  for (const std::string& partial : partial_folders(folder)) {
    struct stat info {};
    if (stat((fs::path(partial) / kCheckpointName).c_str(), &info) == 0) return info.st_ino;
  }
  return 0;
}

/// Kills it some time after it has written so many checkpoints, unless it ends before. Whether it was killed.
bool kill_after(Running& running, const TemporaryFolder& folder, int checkpoints, std::uint32_t waits) {
  ino_t last = checkpoint_file(folder);
  while (checkpoints > 0 && running.lives()) {
    const ino_t now = checkpoint_file(folder);
    checkpoints -= now != last;
    last = now;
    wait_a_little();
  }
  for (std::uint32_t i = 0; i < waits; ++i) wait_a_little();
  if (!running.lives()) return false;
  running.kill_now();
  return true;
}

/// A run of so many evaluations, killed again and again, makes the folder of one that never stopped. How often it was
/// killed: not once, where it ends before anyone looks.
int kill_again_and_again(const std::string& engine, int evaluations) {
  const TemporaryFolder folder;
  testing::write_resumable(folder, evaluations);
  const auto whole = testing::run_program({"run", "scene.toml", "--engine", engine, "--out", "whole"}, folder / "whole",
                                          {.folder = folder.path()});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;

  RandomStream random({11, Purpose::initial, 0, static_cast<std::uint32_t>(engine.size()), 0});
  std::vector<std::string> arguments = {"run", "scene.toml", "--engine", engine, "--out", "out",
                                        "--checkpoint-every", "0.001"};
  int kills = 0;
  for (; kills < 6 && !fs::exists(folder / "out"); ++kills) {  // a kill may come just after the end
    Running running(folder, arguments, "child");
    if (!kill_after(running, folder, 1 + static_cast<int>(random.below(4)), random.below(20))) {
      EXPECT_TRUE(running.done()) << running.err();
      break;
    }
    arguments = {"run", "--resume", "out", "--threads", kills % 2 ? "1" : "2"};
  }
  if (!fs::exists(folder / "out")) {
    // Once more, while results are written; then to the end.
    Running running(folder, {"run", "--resume", "out", "--json"}, "child");
    while (running.lives() && running.out().find("\"writing\"") == std::string::npos) wait_a_little();
    running.kill_now();
    if (!fs::exists(folder / "out")) {
      const auto last = testing::run_program({"run", "--resume", "out"}, folder / "last", {.folder = folder.path()});
      EXPECT_EQ(last.exit_code, 0) << last.err;
      EXPECT_THAT(last.out, HasSubstr("continues from step "));
    }
  }
  testing::expect_same_results(folder / "out", folder / "whole");
  EXPECT_TRUE(partial_folders(folder).empty());
  return kills;
}

class Killing : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Killing, ChangesNothing) {
  const std::string engine(GetParam());
  int kills = 0;
  // As long as it takes to be there in time, on machines of any speed.
  for (int evaluations = 2500; kills == 0 && evaluations < 1'000'000 && !HasFailure(); evaluations *= 4) {
    kills = kill_again_and_again(engine, evaluations);
  }
  EXPECT_GE(kills, 1);
}

INSTANTIATE_TEST_SUITE_P(Run, Killing, ::testing::Values("ga", "sosmc", "rjmcmc", "hybrid", "guided"),
                         [](const auto& engine) { return std::string(engine.param); });

TEST(Killing, TheFolderOfALivingProcessIsNotTaken) {
  const TemporaryFolder folder;
  testing::write_resumable(folder, 1'000'000'000);
  Running running(folder, {"run", "scene.toml", "--out", "out", "--checkpoint-every", "0.001"}, "child");
  while (running.lives() && checkpoint_file(folder) == 0) wait_a_little();
  ASSERT_TRUE(running.lives()) << running.err();
  const auto second = testing::run_program({"run", "--resume", "out"}, folder / "second", {.folder = folder.path()});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.err, HasSubstr("is still at work in it"));
  EXPECT_TRUE(running.lives());
  running.kill_now();
  const auto third = testing::run_program({"run", "--resume", "out", "--generations", "1"}, folder / "third",
                                          {.folder = folder.path()});
  EXPECT_EQ(third.exit_code, 0) << third.err;
}

TEST(Killing, InterruptedItKeepsResultsAndCheckpoint) {
  const TemporaryFolder folder;
  testing::write_resumable(folder, 1'000'000'000);
  testing::ChildOptions options;
  options.folder = folder.path();
  options.interrupt_when = "\"step\":50,";
  const auto first = testing::run_program({"run", "scene.toml", "--out", "out", "--json", "--checkpoint-every", "100"},
                                          folder / "first", options);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::uint64_t step = read_checkpoint(folder / "out/checkpoint").step;
  EXPECT_GE(step, 50u);
  const std::string generations = std::to_string(step + 3);
  const auto more = testing::run_program({"run", "--resume", "out", "--generations", generations, "--json"},
                                         folder / "more", {.folder = folder.path()});
  ASSERT_EQ(more.exit_code, 0) << more.err;
  EXPECT_THAT(more.out, HasSubstr("\"resumed_from\":" + std::to_string(step)));
  EXPECT_THAT(more.out, HasSubstr("\"step\":" + std::to_string(step + 1)));
  const auto whole = testing::run_program({"run", "scene.toml", "--out", "whole", "--generations", generations},
                                          folder / "whole", {.folder = folder.path()});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  testing::expect_same_results(folder / "out", folder / "whole");
}

}  // namespace
}  // namespace espalier
