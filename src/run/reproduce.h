#pragma once
// Reproduce: makes a file anew from its own provenance, and says whether it comes out the same.

#include <string>
#include <vector>

#include "base/executor.h"
#include "model/mesh_source.h"

namespace espalier {

struct ReproduceReport {
  std::string what;                      // "run of spaceship, seed 1, 40 steps"
  std::vector<std::string> same;         // what was compared and is equal
  std::vector<std::string> differences;  // one line each; empty: identical
  std::vector<std::string> notes;

  bool identical() const { return differences.empty(); }
};

/// `run_folder` empty: the folder that the provenance points at. Throws Error for a file without (enough) provenance,
/// or whose inputs are missing.
ReproduceReport reproduce(const std::string& path, const std::string& run_folder, MeshSource& source,
                          Executor& executor);

}  // namespace espalier
