#pragma once
// SpeciesFiles: what a species pack consists of, for the command line's folder and for the room's zip.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/executor.h"
#include "breed/species.h"
#include "model/level_of_detail.h"
#include "model/texture_table.h"
#include "run/grammar_file.h"
#include "run/input_files.h"

namespace espalier {

inline constexpr const char* kSpeciesMarker = "breed.toml";

/// What the files of models are like.
struct SpeciesForm {
  std::string format = "glb";                 // glb, obj, ply or stl
  std::optional<LevelOfDetail> detail = {};   // none: parts as the grammar makes them
  bool all_levels = false;                    // `detail` at every level: NNN-lod0.glb ..
  std::array<std::uint32_t, 2> cell = {240, 240};  // of a model on the sheet
};

/// Throws Error stating rule and value.
void validate(const SpeciesForm& form);

/// Where a species comes from. All must outlive the call.
struct SpeciesOrigin {
  const LoadedGrammar& grammar;
  const MeshTable& meshes;
  const TextureTable& textures;
  const InputFiles& inputs;         // the grammar's, and the favourite's
  std::string favourite;            // its name among the inputs; empty: bred from the grammar
  std::string make_again;           // a command for that folder; empty: no single command does
  std::string settings;             // TOML: all else that it was bred with
  std::uint64_t seed = 1;
};

/// Writes NNN.FORMAT and NNN.derivation.json for each, species.json, species.png, breed.toml and inputs/ into `folder`,
/// which must be there. Triangles of the largest file. Throws Error.
std::uint64_t write_species_files(const SpeciesOrigin& origin, const Species& species, const SpeciesSettings& settings,
                                  const SpeciesForm& form, const std::string& folder, Executor& executor);

}  // namespace espalier
