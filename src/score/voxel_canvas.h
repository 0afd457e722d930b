#pragma once
// VoxelCanvas: what one thread draws a model's parts into: two bit planes in the layout of BitGrid (covered, covered
// twice or more), which stretches of them are in use, and the running sums. Between models the planes are all zero.

#include <cstdint>
#include <vector>

#include "score/bit_grid.h"
#include "score/lattice.h"

namespace espalier {

/// x in [low, high) of one tile row may hold set bits.
struct DirtyRange {
  std::int32_t low = INT32_MAX;
  std::int32_t high = INT32_MIN;

  bool empty() const { return low >= high; }
  void add(std::int32_t from, std::int32_t to) {
    low = from < low ? from : low;
    high = to > high ? to : high;
  }
};

struct VoxelCanvas {
  explicit VoxelCanvas(const Lattice& lattice_of_grid)
      : lattice(lattice_of_grid),
        once(nx(), static_cast<std::uint32_t>(lattice.cells[1]), static_cast<std::uint32_t>(lattice.cells[2])),
        twice(once),
        dirty(std::size_t{once.tile_rows()} * once.depth()) {}

  std::uint32_t nx() const { return static_cast<std::uint32_t>(lattice.cells[0]); }
  std::int32_t depth() const { return static_cast<std::int32_t>(once.depth()); }
  std::int32_t tile_rows() const { return static_cast<std::int32_t>(once.tile_rows()); }

  /// Offset of tile (x = 0) of a tile row, in 32-bit words.
  std::size_t row_offset(std::int32_t tile_row, std::int32_t word) const {
    return (static_cast<std::size_t>(tile_row) * once.depth() + static_cast<std::size_t>(word)) * nx() * 8;
  }
  DirtyRange& range(std::int32_t tile_row, std::int32_t word) {
    return dirty[static_cast<std::size_t>(tile_row) * once.depth() + static_cast<std::size_t>(word)];
  }

  Lattice lattice;
  BitGrid once, twice;
  std::vector<DirtyRange> dirty;
  std::uint64_t hits = 0;     // voxels of the grid, once per part that covers them
  std::uint64_t outside = 0;  // voxels of the window beyond the grid, once per part
};

}  // namespace espalier
