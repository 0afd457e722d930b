// espalier export: a derivation's model in another format.
#include <fmt/format.h>

#include "cmd/attributes.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/model_files.h"

namespace espalier {

int export_verb(const ExportVerbOptions& options) {
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_serial_executor();
  const ExportReport report = export_derivation(
      {options.derivation, options.grammar, parse_attributes(options.attributes), options.out}, source, *executor);
  print_adapted(report.adapted);
  if (report.truncated) fmt::print(stderr, "warning: {}\n", kTruncated);
  fmt::print("wrote {}\n", options.out);
  return kDone;
}

}  // namespace espalier
