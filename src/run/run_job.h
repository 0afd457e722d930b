#pragma once
// RunJob: one run from its first step (or a checkpoint) to its folder.

#include <string>

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
};

/// As run_scene.
bool do_run(const RunJob& job);

}  // namespace espalier
