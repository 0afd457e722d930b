#pragma once
// Provenance: where a file came from and how to make it again. Every GLB, OBJ, PLY, PNG and JSON that Espalier writes
// carries one, as JSON: GLB in asset.extras.espalier, OBJ/MTL/PLY in a comment line "# espalier: {...}" (PLY: "comment
// espalier: {...}"), STL in the 80-byte header as far as it fits ("espalier <version> <derivation hash>"), PNG in a
// tEXt chunk "espalier", JSON documents in a member "provenance".

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace espalier {

struct Provenance {
  std::string version;  // of Espalier
  std::string made_by;  // "run", "sample", "breed", "export", "render" or "preview"
  std::uint64_t seed = 0;
  std::uint64_t steps = 0;  // run: steps the engine had taken
  std::uint64_t index = 0;  // run: 0 = best, n = alternative n; sample: which one
  std::string engine;       // run
  /// Input files by the name they have in the run folder ("inputs/spaceship.esp") to their content_hash.
  std::map<std::string, std::string> inputs;
  std::string settings;       // run: the text of run.toml; sample: its options as TOML
  std::string settings_folder;  // where that file lies, relative to this file: "." or ".."
  std::string derivation;     // hash of the derivation, hex
  std::optional<double> score;
  std::optional<double> optimum;
  std::string picture;  // render: its options as TOML
  std::string mesh;     // export: how its meshes were made, as TOML; empty: as the grammar makes them

  bool operator==(const Provenance&) const = default;
};

/// One line of JSON, keys sorted; and back. parse throws Error for anything else.
std::string to_json(const Provenance& provenance);
Provenance parse_provenance(const std::string& json);

/// Reads the provenance of a file that Espalier wrote, by its content. Throws Error naming the file when there is none.
Provenance read_provenance(const std::string& path);

}  // namespace espalier
