// espalier export: a derivation's model in another format, at one level of detail or all.
#include <fmt/format.h>

#include "base/counted.h"
#include "base/error.h"
#include "cmd/attributes.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/mesh_look.h"
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
  if (options.lods && options.lod) throw Error("--lod and --lods exclude each other");
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_serial_executor();
  const ExportReport report =
      export_derivation({options.derivation, options.grammar, parse_attributes(options.attributes), options.out,
                         read_level_of_detail(options.joints, options.lod), options.lods},
                        source, *executor);
  print_adapted(report.adapted);
  if (report.truncated) fmt::print(stderr, "warning: {}\n", kTruncated);
  if (options.lods) print_levels(report.files);
  for (const ExportReport::File& file : report.files)
    fmt::print("wrote {}, {}\n", file.path, counted(file.triangles, "triangle"));
  return kDone;
}

}  // namespace espalier
