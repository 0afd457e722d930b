// espalier sample: models drawn from a grammar.
#include "run/sample.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/counted.h"
#include "cmd/attributes.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/find_derivation.h"

namespace espalier {

int sample_verb(const SampleOptions& options) {
  namespace fs = std::filesystem;
  SampleRequest request;
  request.grammar = options.grammar;
  request.attributes = parse_attributes(options.attributes);
  request.count = options.count;
  request.seed = options.seed;
  request.grow = options.grow;
  request.genes = options.genes;
  if (!options.from.empty()) request.from = find_derivation(options.from);
  if (!options.cell.empty()) request.cell = {options.cell[0], options.cell[1]};
  request.columns = options.columns;
  std::string out = options.out;
  if (out.empty()) out = (fs::path("out") / (fs::path(options.grammar).stem().string() + "-samples")).string();
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_tbb_executor(options.threads);
  const SampleFiles which = options.only_genes ? SampleFiles::genes : SampleFiles::all;
  for (const std::string& warning : write_samples(request, out, source, *executor, which)) {
    fmt::print(stderr, "warning: {}\n", warning);
  }
  fmt::print("wrote {} to {}\n", counted(options.count, "sample"), out);
  if (!options.only_genes) fmt::print("wrote {}\n", (fs::path(out) / "samples.png").string());
  return kDone;
}

}  // namespace espalier
