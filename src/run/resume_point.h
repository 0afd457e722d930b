#pragma once
// ResumePoint: the folder whose checkpoint a run goes on from, among those that a path may mean.

#include <optional>
#include <string>
#include <vector>

#include "run/checkpoint.h"
#include "run/folder_lock.h"

namespace espalier {

struct ResumePoint {
  std::string folder;              // holds checkpoint, run.toml and inputs/
  std::string path;                // what the folder of the run is to be called
  std::optional<FolderLock> lock;  // of what an ended process left behind; a finished run's folder has none
  Checkpoint checkpoint;

  bool finished() const { return !lock; }
};

/// `path` is the folder of a run, or by its own name one that an ended process left behind (PATH.partial-XXXXXX). Of a
/// run's folder: what was left behind beside it if that is one, else its own checkpoint. Throws Error where there is
/// none, several, a damaged one, or a process at work.
ResumePoint find_resume_point(const std::string& path);

/// The folders with checkpoints that ended processes left behind beside the folder of a run, with their steps:
/// "out/ship.partial-Ab12Cd (step 120)".
std::vector<std::string> left_behind(const std::string& path);

/// The earlier runs of that name (PATH.replaced-XXXXXX) whose removal a kill or a power cut has prevented.
std::vector<std::string> moved_aside(const std::string& path);

}  // namespace espalier
