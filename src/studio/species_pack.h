#pragma once
// SpeciesPack: siblings of a favourite as a folder of model files with an index and a contact sheet. For the command
// line and for the breeding room.

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/executor.h"
#include "breed/species.h"
#include "model/mesh_source.h"
#include "studio/species_files.h"

namespace espalier {

struct SpeciesRequest {
  /// A derivation (.derivation.json, or a model or picture that was made of one, or a run's folder): its siblings; or a
  /// grammar (.esp) or scene (.toml): what it grows.
  std::string from;
  std::string grammar;                            // of a derivation; empty: the copy in the folder of its run
  std::map<std::string, std::string> attributes;  // as the language writes them
  SpeciesSettings settings;
  std::optional<std::uint64_t> most_triangles;    // of a file; of the finest where there is one per level
  std::uint64_t seed = 1;
  SpeciesForm form;
};

struct SpeciesReport {
  std::uint32_t found = 0;
  double nearest = 0;       // least distance of any two
  std::uint64_t triangles = 0;  // of the largest file
  std::string words;        // how many were found, and why not more
};

/// Writes the files (write_species_files) into a new folder `out` (see RunFolder), also where fewer were found than
/// asked for; nothing where none was. Of a scene the hard limits count too, not its targets. Throws Error.
SpeciesReport write_species(const SpeciesRequest& request, const std::string& out, MeshSource& source,
                            Executor& executor);

}  // namespace espalier
