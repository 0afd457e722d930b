#pragma once
// Derivation files: reading one back, scoring it against a scene, and exporting its model.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "derivation/derivation.h"
#include "io/provenance.h"
#include "model/level_of_detail.h"
#include "model/mesh_source.h"
#include "run/grammar_file.h"
#include "run/scene.h"
#include "score/target.h"

namespace espalier {

/// What setting attributes anew did to a derivation (derivation/adapt.h).
struct AdaptedGenes {
  std::uint32_t cut = 0, grown = 0;
};

/// The score of a derivation file in a scene, taken apart. A derivation made with other attributes is an error, unless
/// `adapted` is given: then it is adapted to those of the scene. Throws Error.
Explanation score_derivation(const Scene& scene, const std::string& derivation_path, MeshSource& source,
                             AdaptedGenes* adapted = nullptr);

struct LoadedDerivation {
  LoadedGrammar grammar;
  Derivation derivation;
  AdaptedGenes adapted;
};
/// A derivation and its grammar: the file named by `grammar`, or (where that is empty) the copy in the folder of the
/// derivation's run, or where there is none the one that lies near (find_grammar.h). The derivation is adapted to
/// `attributes`, if any are set anew. Throws Error.
LoadedDerivation load_derivation(const std::string& path, const std::string& grammar,
                                 const std::map<std::string, std::string>& attributes);

/// Where the folder of a run lies, by the provenance of one of its files at `path`.
std::string settings_folder_of(const std::string& path, const Provenance& provenance);

/// The grammar that the settings of a run or of samples in `folder` name, with its attributes set. `name` stands for
/// the settings in messages. Throws Error.
LoadedGrammar grammar_of_settings(const std::string& settings, const std::string& name, const std::string& folder,
                                  const std::map<std::string, std::string>& attributes);

/// Provenance of a file at `out` made of a derivation file: the derivation's own as seen from there if it was taken as
/// it is, with its own grammar and attributes; else the hashes of the grammar's files.
Provenance made_from(const std::string& derivation_path, bool as_it_is, const LoadedGrammar& grammar,
                     const Derivation& derivation, const std::string& out);

struct ExportRequest {
  std::string derivation;                         // path of a .derivation.json
  std::string grammar;                            // path; empty: the copy in the folder of its run
  std::map<std::string, std::string> attributes;  // set anew; the derivation is adapted to them
  std::string out;                                // .glb .obj .ply .stl
  std::optional<LevelOfDetail> detail = {};       // none: parts as the grammar makes them
  bool all_levels = false;                        // `detail` at every level: NAME-lod0.glb ..
};
struct ExportReport {
  struct File {
    std::string path;
    std::uint64_t triangles = 0;
  };
  AdaptedGenes adapted;
  bool truncated = false;  // a budget of the model ran out: it is not whole
  std::vector<File> files = {};
};
/// Writes the model of a derivation, grown once, into one file or one per level of detail. Throws Error.
ExportReport export_derivation(const ExportRequest& request, MeshSource& source, Executor& executor);

}  // namespace espalier
