#pragma once
// Writing models. The format follows the file name: .glb, .obj (with .mtl and textures beside it), .ply, .stl. Only
// what `full` or `parts` shows is written. Files are written to a temporary name in the same folder and renamed when
// whole.

#include <cstdint>
#include <optional>
#include <string>

#include "io/provenance.h"
#include "model/level_of_detail.h"
#include "model/model.h"
#include "model/surfaces.h"

namespace espalier {

struct ExportOptions {
  bool full = true;                // else parts
  bool gpu_instancing = false;     // GLB: EXT_mesh_gpu_instancing, as required extension
  std::optional<LevelOfDetail> detail = {};  // none: parts as the grammar makes them
};

/// Gives the number of triangles that were written. Throws Error naming the file (unknown ending, unwritable folder,
/// full disk); then the old file, if any, is untouched.
std::uint64_t export_model(const std::string& path, const Model& model, const MeshTable& meshes,
                           const Surfaces& surfaces, const Provenance& provenance, const ExportOptions& options = {});

}  // namespace espalier
