#pragma once
// From meshes to bit grids: which voxel centres lie inside a mesh. Used for targets, for pictures of voxels, by tests.

#include <span>

#include "model/mesh.h"
#include "model/model.h"
#include "score/bit_grid.h"
#include "score/voxel_grid.h"

namespace espalier {

/// A mesh as voxels. `open_edges` > 0 says that the mesh is not closed and its inside was guessed.
struct VoxelisedMesh {
  BitGrid voxels;
  std::size_t open_edges = 0;
};

/// Voxels of a mesh given in model space: a centre is inside when a ray along z crosses the surface an odd number of
/// times on either side of it. Orientation does not matter; nested shells are hollow. Where the mesh is not closed,
/// rays along x, y and z vote and two of three decide. Double precision; neighbouring triangles never both or neither
/// count on their common edge. The grid must be valid.
VoxelisedMesh voxelise(const Mesh& mesh, const VoxelGrid& grid);

}  // namespace espalier
