#include "score/voxelise.h"

#include <algorithm>

#include "score/facet_scan.h"

namespace espalier {
namespace {

/// Parity along axis `along`; the grid's axes are turned so that it becomes z.
BitGrid scan_along(const Mesh& mesh, const Lattice& lattice, int along) {
  const int axis[3] = {(along + 1) % 3, (along + 2) % 3, along};
  GridPlacement placement{};
  std::int32_t low[3] = {0, 0, 0}, high[3];
  for (int i = 0; i < 3; ++i) {
    const int k = axis[i];
    placement.m[i][k] = lattice.scale[k];
    placement.o[i] = -lattice.origin[k] * lattice.scale[k] - lattice.centre[k];
    high[i] = lattice.cells[k];
  }
  BitGrid voxels(static_cast<std::uint32_t>(high[0]), static_cast<std::uint32_t>(high[1]),
                 static_cast<std::uint32_t>(high[2]));
  FacetScan scan;
  if (!scan.begin(mesh, placement, low, high)) return voxels;
  const Reach& reach = scan.reach();
  for (std::int32_t tile = reach.low[1] / 8; tile * 8 < reach.high[1]; ++tile) {
    const std::uint32_t* bits = scan.scan(tile);
    for (std::int32_t x = reach.low[0]; x < reach.high[0]; ++x) {
      for (std::int32_t w = 0; w < scan.words(); ++w, bits += 8) {
        const std::size_t to = voxels.word_index(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(tile * 8),
                                                 static_cast<std::uint32_t>(32 * (scan.first_word() + w)));
        std::copy(bits, bits + 8, voxels.data() + to);
      }
    }
  }
  return voxels;
}

}  // namespace

VoxelisedMesh voxelise(const Mesh& mesh, const VoxelGrid& grid) {
  const Lattice lattice(grid);
  VoxelisedMesh result;
  result.open_edges = open_edges(mesh);
  result.voxels = scan_along(mesh, lattice, 2);
  if (result.open_edges == 0) return result;
  // Axes turned: in the first x is (nx, ny, nz) seen as (y, z, x), in the second as (z, x, y).
  const BitGrid along_x = scan_along(mesh, lattice, 0), along_y = scan_along(mesh, lattice, 1);
  BitGrid vote(grid.cells[0], grid.cells[1], grid.cells[2]);
  for (std::uint32_t y = 0; y < grid.cells[1]; ++y) {
    for (std::uint32_t z = 0; z < grid.cells[2]; ++z) {
      for (std::uint32_t x = 0; x < grid.cells[0]; ++x) {
        const int votes = result.voxels.get(x, y, z) + along_x.get(y, z, x) + along_y.get(z, x, y);
        if (votes >= 2) vote.set(x, y, z);
      }
    }
  }
  result.voxels = std::move(vote);
  return result;
}

}  // namespace espalier
