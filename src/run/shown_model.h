#pragma once
// ShownModel: what a path that a person names shows, whatever kind of file it is.

#include <map>
#include <string>

#include "model/mesh_source.h"
#include "model/shell.h"
#include "run/derivation_file.h"

namespace espalier {

struct ShownModel {
  static constexpr std::uint64_t kMostTriangles = 200'000'000;  // 20 s to look through

  Shell shell;
  bool is_mesh = false;     // read as it is; else built from a derivation
  AdaptedGenes adapted;     // of a derivation
  bool truncated = false;   // a budget ran out: it is not whole
};

/// Whether `path` is read as a mesh file: not if it is a folder, or ends as derivations and pictures do.
bool names_mesh(const std::string& path);

/// A mesh file as it is, whoever made it; or the model of the derivation that `path` names (find_derivation), with its
/// details, built by `grammar` and with `attributes` as load_derivation does. Throws Error naming the path, also where
/// there are more than `most_triangles`.
ShownModel load_shown_model(const std::string& path, const std::string& grammar,
                            const std::map<std::string, std::string>& attributes, MeshSource& source,
                            std::uint64_t most_triangles = ShownModel::kMostTriangles);

}  // namespace espalier
