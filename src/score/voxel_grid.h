#pragma once
// VoxelGrid: the lattice on which volumes are counted. A voxel stands for its centre; cells may be cubes or bricks.

#include <cstdint>
#include <span>

#include "base/vec.h"
#include "model/mesh.h"

namespace espalier {

/// Most cells of a grid, and most along one axis (32-bit floats still tell 1e-4 of a cell apart there).
inline constexpr std::uint64_t kMostVoxels = 64'000'000;
inline constexpr std::uint32_t kMostVoxelsPerAxis = 4096;

/// A lattice of cubes or bricks. Cell (x, y, z) spans min + (x, y, z) * cell .. + cell; samples are taken at centres.
/// Linear order: x fastest, then y, then z (x + nx * (y + ny * z)).
struct VoxelGrid {
  Vec3 min{0};
  Vec3 max{1};
  std::uint32_t cells[3] = {1, 1, 1};

  Vec3 cell_size() const {
    return (max - min) / Vec3(static_cast<float>(cells[0]), static_cast<float>(cells[1]), static_cast<float>(cells[2]));
  }
  std::uint64_t cell_count() const { return std::uint64_t{cells[0]} * cells[1] * cells[2]; }
  std::uint64_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + std::uint64_t{cells[0]} * (y + std::uint64_t{cells[1]} * z);
  }
};

/// Throws Error unless min < max and 1 <= cells <= the two limits above; `name` says whose grid it is.
void validate(const VoxelGrid& grid, const char* name);

/// The box around all targets plus 10 % of its size, cut into about `cells` cubes. Throws Error when the targets have
/// no triangles or no extent.
VoxelGrid default_grid(std::span<const Mesh> targets, std::uint64_t cells = 2'000'000);

/// Where exactly a voxel is sampled: its centre moved by these parts of a cell along x, y, z. A face that lies on
/// centres, common in grammars with round numbers, is so decided in one way everywhere, whatever the rounding of the
/// frames: the voxel belongs to the solid on the +z side, for upright faces on the +x side, then +y. Boxes that touch
/// do not overlap.
inline constexpr double kSampleNudge[3] = {0x1p-13, 0x1p-14, 0x1p-12};

/// Voxels beyond the grid are counted in a window of the same lattice that goes on for this many grid sizes on every
/// side (3 x 3 x 3 grids in all). What lies further out counts nothing, so a huge part costs no more than the window.
inline constexpr std::int32_t kWindowGrids = 1;

}  // namespace espalier
