#pragma once
// VoxelCanvas: what one thread draws a model's parts into: two bit planes in the layout of BitGrid (covered, covered
// twice or more), which blocks of them are in use, and the running sums. Between models the planes are all zero.

#include <cstdint>
#include <vector>

#include "score/bit_grid.h"
#include "score/lattice.h"

namespace espalier {

/// Tiles along x whose use is noted together, in one bit.
inline constexpr std::int32_t kBlockTiles = 4;

struct VoxelCanvas {
  static constexpr std::size_t kTileWords = 8;

  explicit VoxelCanvas(const Lattice& lattice_of_grid)
      : lattice(lattice_of_grid),
        once(nx(), static_cast<std::uint32_t>(lattice.cells[1]), static_cast<std::uint32_t>(lattice.cells[2])),
        twice(once),
        blocks((nx() + kBlockTiles - 1) / kBlockTiles),
        dirty_words((blocks + 63) / 64),
        dirty(std::size_t{once.tile_rows()} * once.depth() * dirty_words) {}

  std::uint32_t nx() const { return static_cast<std::uint32_t>(lattice.cells[0]); }
  std::int32_t depth() const { return static_cast<std::int32_t>(once.depth()); }
  std::int32_t tile_rows() const { return static_cast<std::int32_t>(once.tile_rows()); }

  /// Of a tile row, in 32-bit words.
  std::size_t row_words() const { return std::size_t{nx()} * kTileWords; }
  /// Offset of tile (x = 0) of a tile row, in 32-bit words.
  std::size_t row_offset(std::int32_t tile_row, std::int32_t word) const {
    return (static_cast<std::size_t>(tile_row) * once.depth() + static_cast<std::size_t>(word)) * row_words();
  }
  std::uint64_t* dirty_row(std::int32_t tile_row, std::int32_t word) {
    const std::size_t row = static_cast<std::size_t>(tile_row) * once.depth() + static_cast<std::size_t>(word);
    return dirty.data() + row * dirty_words;
  }
  /// Notes that tiles x in [from, to) of a tile row may hold set bits; from < to.
  void mark(std::int32_t tile_row, std::int32_t word, std::int32_t from, std::int32_t to) {
    std::uint64_t* row = dirty_row(tile_row, word);
    const std::int32_t first = from / kBlockTiles, last = (to - 1) / kBlockTiles;
    if (dirty_words == 1) {
      *row |= ~0ull >> (63 - last) & ~0ull << first;
      return;
    }
    for (std::int32_t i = first >> 6; i <= last >> 6; ++i) {
      const std::uint64_t below = i == last >> 6 ? ~0ull >> (63 - (last & 63)) : ~0ull;
      row[i] |= below & (i == first >> 6 ? ~0ull << (first & 63) : ~0ull);
    }
  }

  Lattice lattice;
  BitGrid once, twice;
  std::uint32_t blocks, dirty_words;  // of one tile row
  std::vector<std::uint64_t> dirty;   // one bit per block of tiles
  std::uint64_t hits = 0;     // voxels of the grid, once per part that covers them
  std::uint64_t outside = 0;  // voxels of the window beyond the grid, once per part
};

}  // namespace espalier
