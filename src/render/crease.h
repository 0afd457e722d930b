#pragma once
// Crease: normals for ghosts. Files bring none, or one per face; a curved target should still look smooth and an edged
// one edged.

#include "model/mesh.h"

namespace espalier {

/// The mesh with a normal per corner: the mean of the faces that meet there (weighted by area) whose own normals are
/// within about 40 degrees. Triangles without area are dropped.
Mesh with_crease_normals(const Mesh& mesh);

}  // namespace espalier
