// espalier export: a derivation's model in another format, at one level of detail or all.
#include <fmt/format.h>

#include "base/counted.h"
#include "cmd/attributes.h"
#include "cmd/detail.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/model_files.h"

namespace espalier {
namespace {

void print_levels(const std::vector<ExportReport::File>& files) {
  fmt::print("level  triangles  of lod0\n");
  const auto finest = static_cast<double>(files[0].triangles);
  for (std::size_t level = 0; level < files.size(); ++level) {
    const auto triangles = static_cast<double>(files[level].triangles);
    fmt::print("lod{}   {:9}  {:5.1f} %\n", level, files[level].triangles, finest > 0 ? 100 * triangles / finest : 0.0);
  }
}

}  // namespace

int export_verb(const ExportVerbOptions& options) {
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_serial_executor();
  const ExportReport report =
      export_derivation({options.derivation, options.grammar, parse_attributes(options.attributes), options.out,
                         level_of(options.detail), options.detail.lods},
                        source, *executor);
  print_adapted(report.adapted);
  if (report.truncated) fmt::print(stderr, "warning: {}\n", kTruncated);
  if (options.detail.lods) print_levels(report.files);
  for (const ExportReport::File& file : report.files)
    fmt::print("wrote {}, {}\n", file.path, counted(file.triangles, "triangle"));
  return kDone;
}

}  // namespace espalier
