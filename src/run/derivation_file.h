#pragma once
// Derivation files: reading one back, scoring it against a scene, and exporting its model.

#include <map>
#include <string>

#include "base/executor.h"
#include "derivation/derivation.h"
#include "model/mesh_source.h"
#include "run/grammar_file.h"
#include "run/scene.h"
#include "score/target.h"

namespace espalier {

/// The score of a derivation file in a scene, taken apart. Throws Error.
Explanation score_derivation(const Scene& scene, const std::string& derivation_path, MeshSource& source);

struct LoadedDerivation {
  LoadedGrammar grammar;
  Derivation derivation;
};
/// A derivation and its grammar: the file named by `grammar`, with `attributes`, or (where that is empty) the copy in
/// the folder of the derivation's run. Throws Error.
LoadedDerivation load_derivation(const std::string& path, const std::string& grammar,
                                 const std::map<std::string, std::string>& attributes);

struct ExportRequest {
  std::string derivation;                         // path of a .derivation.json
  std::string grammar;                            // path; empty: the copy in the folder of its run
  std::map<std::string, std::string> attributes;  // with `grammar` only
  std::string out;                                // .glb .obj .ply .stl
};
/// Writes the model of a derivation. Throws Error.
void export_derivation(const ExportRequest& request, MeshSource& source, Executor& executor);

}  // namespace espalier
