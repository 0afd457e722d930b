#pragma once
// RunJob: one run from its first step (or a checkpoint) to its folder.

#include <string>
#include <vector>

#include "run/run.h"
#include "run/run_folder.h"
#include "run/search_session.h"

namespace espalier {

struct RunJob {
  const Setup& setup;
  RunFolder& folder;
  Executor& executor;
  SearchSession& session;
  RunObserver& observer;
  const std::atomic<bool>* stop = nullptr;
  std::string resumed_folder = "";  // whose checkpoint the session has loaded
  std::vector<std::string> notes = {};  // warnings of what lies around, which is no part of the results
};

/// As run_scene.
bool do_run(const RunJob& job);

/// A line for each earlier run of the folder's name that still lies beside it (run/resume_point.h).
void warn_of_moved(const std::string& path, std::vector<std::string>& warnings);

}  // namespace espalier
