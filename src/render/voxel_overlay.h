#pragma once
// Voxel overlay: what a model fills of the volumes asked for, voxel by voxel in colours: seen whole from one side, and
// in three cuts.

#include <array>
#include <cstdint>
#include <vector>

#include "base/executor.h"
#include "base/vec.h"
#include "render/paint.h"

namespace espalier {

enum class VoxelMark : std::uint8_t {
  free,       // nothing there, and nothing wanted
  missed,     // wanted, not covered
  filled,     // wanted and covered
  spilled,    // covered, and nothing wanted there
  elsewhere,  // the same, where no mesh is to be filled: does not matter
  avoided,    // to be avoided, not covered
  struck,     // to be avoided, and covered
};

struct MarkedVoxels {
  std::array<std::uint32_t, 3> cells = {1, 1, 1};
  Vec3 min{0}, max{1};               // of the grid, metres
  std::vector<std::uint8_t> voxels;  // VoxelMark, kTwice added where two parts or more cover it; x fastest, then y

  static constexpr std::uint8_t kTwice = 0x80;

  std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + std::size_t{cells[0]} * (y + std::size_t{cells[1]} * z);
  }
  VoxelMark mark(std::size_t i) const { return static_cast<VoxelMark>(voxels[i] & 0x7f); }
  bool twice(std::size_t i) const { return (voxels[i] & kTwice) != 0; }
};

inline bool is_covered(VoxelMark mark) {
  return mark == VoxelMark::filled || mark == VoxelMark::spilled || mark == VoxelMark::elsewhere ||
         mark == VoxelMark::struck;
}

/// Darker where covered twice.
Colour colour_of(VoxelMark mark, bool twice = false);

/// Which plane of cells across each axis holds most that is wanted or covered; the lowest of several.
std::array<std::uint32_t, 3> fullest_cuts(const MarkedVoxels& voxels);

/// The whole from the right above, covered voxels solid and missed ones as a haze; beside it cuts across z (seen from
/// the front), x (from the right) and y (from above) where most is to be seen. About `across` pixels wide.
/// `samples`: along each side of a pixel of the view.
Picture draw_voxels(const MarkedVoxels& voxels, std::uint32_t across, std::uint32_t samples, Executor& executor);

}  // namespace espalier
