// espalier breed: many distinct models of one kind.
#include <filesystem>

#include <fmt/format.h>

#include "cmd/attributes.h"
#include "cmd/detail.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "studio/species_pack.h"

namespace espalier {

int breed_verb(const BreedOptions& options) {
  namespace fs = std::filesystem;
  SpeciesRequest request;
  request.from = options.from;
  request.grammar = options.grammar;
  request.attributes = parse_attributes(options.attributes);
  request.settings.count = options.count;
  request.settings.strength = options.strength;
  request.settings.least_distance = options.least_distance;
  request.most_triangles = options.most_triangles;
  request.seed = options.seed;
  request.form.format = options.format;
  request.form.detail = level_of(options.detail);
  request.form.all_levels = options.detail.lods;
  const std::string out =
      !options.out.empty() ? options.out
                           : (fs::path("out") / (fs::path(options.from).stem().stem().string() + "-species")).string();
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_tbb_executor(options.threads);
  const SpeciesReport report = write_species(request, out, source, *executor);
  fmt::print("{}\n", report.words);
  if (report.found > 0) {
    fmt::print("wrote {} to {}, at most {} triangles each; the two most alike are {:.3f} apart\n", report.found, out,
               report.triangles, report.nearest);
  }
  if (report.found == options.count) return kDone;
  fmt::print(stderr, "fewer than {}: allow more triangles, stray farther (--strength) or start from another model\n",
             options.count);
  return kDiffers;
}

}  // namespace espalier
