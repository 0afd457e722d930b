// espalier reproduce: makes a file anew and compares.
#include "run/reproduce.h"

#include <fmt/format.h>

#include "cmd/verbs.h"
#include "io/mesh_import.h"

namespace espalier {

int reproduce_verb(const ReproduceOptions& options) {
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_tbb_executor(options.threads);
  const ReproduceReport report = reproduce(options.file, options.run_folder, source, *executor);
  if (!report.what.empty()) fmt::print("{}\n", report.what);
  for (const std::string& note : report.notes) fmt::print("note: {}\n", note);
  for (const std::string& same : report.same) fmt::print("same: {}\n", same);
  for (const std::string& difference : report.differences) fmt::print("differs: {}\n", difference);
  fmt::print("{}\n", report.identical() ? "identical" : "not identical");
  return report.identical() ? kDone : kDiffers;
}

}  // namespace espalier
