#pragma once
// MeshSource: where mesh files come from. Implemented by io/mesh_import; tests give meshes of their own.

#include <string>

#include "model/mesh.h"

namespace espalier {

class MeshSource {
 public:
  virtual ~MeshSource() = default;
  /// The mesh in the file's own coordinates; parts and nodes are flattened into one. Throws Error naming the file when
  /// it is missing, unreadable, empty, too large or holds coordinates that are not finite.
  virtual Mesh load(const std::string& path) = 0;
};

}  // namespace espalier
