#pragma once
// Runs of a small scene that are left as if killed, and go on from there.

#include <functional>

#include <gtest/gtest.h>

#include "base/error.h"
#include "run/resume_runs.h"

namespace espalier::testing {

class Telling final : public RunObserver {
 public:
  void started(const RunStart& start) override { resumed_from = start.resumed_from, folder = start.resumed_folder; }
  void step(const StepReport& report) override {
    if (first_step == 0) first_step = report.step;
    if (on_step) on_step(report);
  }
  void warning(const std::string& text) override { warnings += text + "\n"; }

  std::uint64_t resumed_from = 0, first_step = 0;
  std::string folder, warnings;
  std::function<void(const StepReport&)> on_step;
};

class Resuming : public ::testing::Test {
 protected:
  Resuming() { write_resumable(folder_, 40); }

  bool run(const std::string& out, double checkpoint_seconds, Telling& observer, const SceneOverrides& overrides = {},
           int threads = 1) {
    AssimpMeshSource source;
    Scene scene = load_scene(folder_ / "scene.toml", overrides);
    scene.threads = threads;
    scene.checkpoint_seconds = checkpoint_seconds;
    return run_scene(scene, {folder_ / out, nullptr, &observer}, source);
  }

  void resume(ResumeRequest request, Telling& observer, const std::string& out = "") {
    AssimpMeshSource source;
    request.folder = folder_ / request.folder;
    ASSERT_TRUE(resume_run(request, {out.empty() ? "" : folder_ / out, nullptr, &observer}, source));
  }
  void resume(const ResumeRequest& request) {
    Telling observer;
    resume(request, observer);
  }
  std::string error_of(ResumeRequest request) {
    AssimpMeshSource source;
    request.folder = folder_ / request.folder;
    try {
      resume_run(request, {"", nullptr, nullptr}, source);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  /// A run that ends at `stop` as if killed: what lies in its folder then is left under `left`.
  void leave(const std::string& left, std::uint64_t stop, const SceneOverrides& overrides = {}, int threads = 1) {
    Telling observer;
    observer.on_step = [&](const StepReport& report) {
      if (report.step != stop + 1) return;
      for (const std::string& partial : partial_folders(folder_)) {
        if (partial.find("/whole.partial-") == std::string::npos) continue;
        fs::copy(partial, folder_ / left, fs::copy_options::recursive);
      }
    };
    ASSERT_TRUE(run("whole", 1e-9, observer, overrides, threads));
    ASSERT_TRUE(fs::exists(folder_ / (left + "/checkpoint")));
  }
  std::uint64_t step_in(const std::string& folder) { return read_checkpoint(folder_ / (folder + "/checkpoint")).step; }

  TemporaryFolder folder_;
};

}  // namespace espalier::testing
