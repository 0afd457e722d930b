#pragma once
// Run: a scene from file to folder: set up, search, write. Layout of the folder: docs/scenes.md.

#include <atomic>
#include <optional>
#include <string>

#include "run/progress.h"
#include "run/scene.h"

namespace espalier {

class MeshSource;

struct RunOptions {
  std::string out;                          // folder to make or replace; resumed: empty stands for the run's own
  const std::atomic<bool>* stop = nullptr;  // set from outside: end with the best so far
  RunObserver* observer = nullptr;          // may be null
};

/// False if it was stopped before there was any result; then nothing is left behind. Throws Error, leaving nothing
/// behind either, unless there is a checkpoint, or writing failed half-way: then what could be written is kept, and the
/// message says where.
bool run_scene(const Scene& scene, const RunOptions& options, MeshSource& source);

struct ResumeRequest {
  std::string folder;  // of a run, or what was left behind of one (run/resume_point.h)
  SceneBudget budget = {};  // of the whole run, what is done already included; nothing given: as it was
  std::optional<int> threads = {};
  std::optional<double> checkpoint_seconds = {};
  /// Where the search cannot go on as the same search: another one, from the checkpoint's models.
  bool force = false;
};

/// Goes on from a checkpoint, to the very results of a run that never stopped; otherwise as run_scene. Throws Error too
/// where there is no checkpoint, something changed since, or a finished run's budget is spent.
bool resume_run(const ResumeRequest& request, const RunOptions& options, MeshSource& source);

}  // namespace espalier
