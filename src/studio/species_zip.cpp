#include "studio/species_zip.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "breed/species.h"
#include "io/file.h"
#include "run/model_files.h"
#include "run/temporary_folder.h"
#include "studio/breeding_settings.h"
#include "studio/export_model.h"
#include "studio/zip.h"

namespace espalier::studio {

std::string species_zip(BreedingBench& bench, Executor& executor, const Derivation& favourite, std::uint32_t count,
                        std::int64_t most_triangles, std::uint64_t seed, const std::string& stem) {
  const api::RoomSettings limits = complete(api::RoomSettings{.max_triangles = most_triangles});
  const BreedProblem problem = bench.problem(limits, seed, {});
  SpeciesSettings settings;
  settings.count = count;
  const Species species = find_species(problem, favourite, settings);
  const std::string words = summary(species, settings);
  if (species.siblings.empty()) throw Error(words);
  const Setup& setup = *bench.setup();
  const TemporaryFolder folder;
  const std::vector<Mesh> no_ghosts;
  ModelFiles files(setup.graph(), setup.meshes, setup.textures, no_ghosts, {}, executor);
  ZipWriter zip;
  nlohmann::ordered_json index = {
      {"espalier_species", 1}, {"words", words}, {"seed", seed}, {"models", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < species.siblings.size(); ++i) {
    ShownModel shown;
    shown.setup = bench.setup();
    shown.derivation = species.siblings[i];
    const std::string name = fmt::format("{:03}.glb", i + 1), path = folder.file(name);
    files.write(shown.derivation, path, provenance_of(shown));
    zip.add(stem + "/" + name, read_file(path));
    const PerMeasure<double>& measures = species.appraisals[i].measures;
    index["models"].push_back({{"file", name},
                               {"triangles", measures[Measure::triangles]},
                               {"height", measures[Measure::height]},
                               {"spread", measures[Measure::spread]}});
  }
  zip.add(stem + "/species.json", index.dump(1) + "\n");
  return zip.finish();
}

}  // namespace espalier::studio
