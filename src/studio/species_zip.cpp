#include "studio/species_zip.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/encode.h"
#include "io/file.h"
#include "run/temporary_folder.h"
#include "run/toml_value.h"
#include "studio/species_files.h"
#include "studio/zip.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

/// With what a session holds its relatives together, for people: no command takes locks of draws or targets.
std::string settings_of(const SpeciesZipRequest& request) {
  std::string text;
  const auto limit = [&](const char* name, double most) {
    if (most > 0) text += fmt::format("{} = {}\n", name, most);
  };
  limit("most_triangles", static_cast<double>(request.settings.max_triangles.value_or(0)));
  limit("most_height_m", request.settings.max_height.value_or(0));
  limit("most_spread_m", request.settings.max_spread.value_or(0));
  std::string locked;
  for (const api::DrawPlace& place : request.locked) {
    locked += (locked.empty() ? "" : ", ") + quote_toml(fmt::format("{}: draw {}", place.path, place.index));
  }
  if (!locked.empty()) text += fmt::format("locked = [{}]\n", locked);
  return text;
}

}  // namespace

std::string species_zip(BreedingBench& bench, Executor& executor, const Derivation& favourite,
                        const SpeciesZipRequest& request) {
  const BreedProblem problem = bench.problem(request.settings, request.seed, request.locked);
  SpeciesSettings settings;
  settings.count = request.count;
  const Species species = find_species(problem, favourite, settings);
  if (species.siblings.empty()) throw Error(summary(species, settings));
  const Setup& setup = *bench.setup();
  const TemporaryFolder scratch;
  const std::string start = scratch.file("favourite.derivation.json"), pack = scratch.file("pack");
  write_file(start, encode(setup.graph(), favourite));
  InputFiles inputs = setup.inputs;
  const std::string name = inputs.add_start(start).name;
  fs::create_directory(pack);
  write_species_files({setup.grammar, setup.meshes, setup.textures, inputs, name, "", settings_of(request), request.seed},
                      species, settings, {}, pack, executor);
  return zip_of_folder(pack, request.stem);
}

}  // namespace espalier::studio
