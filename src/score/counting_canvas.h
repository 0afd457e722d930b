#pragma once
// CountingCanvas: how many parts cover each voxel, as bit planes: plane k holds the bits of worth 2^k. The planes of a
// tile lie side by side, blocks of kBlockTiles tiles one after the other, so that what a part touches is one piece of
// memory. Blocks are copied before they are changed for the first time, which makes every change undoable.

#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "score/bit_grid.h"
#include "score/lattice.h"
#include "score/voxel_canvas.h"

namespace espalier {

/// Up to 2^kCountPlanes - 1 parts per voxel: the balls that stand for a tree's leaves lie dozens deep.
inline constexpr std::size_t kCountPlanes = 6;

struct CountingCanvas {
  static constexpr std::size_t kTileWords = 8 * kCountPlanes;
  static constexpr std::size_t kBlockWords = kBlockTiles * kTileWords;

  explicit CountingCanvas(const Lattice& lattice_of_grid)
      : lattice(lattice_of_grid),
        words_deep((static_cast<std::uint32_t>(lattice.cells[2]) + 31) / 32),
        blocks((static_cast<std::uint32_t>(lattice.cells[0]) + kBlockTiles - 1) / kBlockTiles),
        rows((static_cast<std::uint32_t>(lattice.cells[1]) + 7) / 8 * words_deep),
        marks_per_row((blocks + 63) / 64),
        planes(std::size_t{rows} * blocks * kBlockWords),
        marked(std::size_t{rows} * marks_per_row),
        used(marked.size()) {}

  /// Of the planes and of copies of all blocks.
  static std::size_t bytes(const Lattice& lattice) {
    const auto over = [&](int axis, std::size_t per) {
      return (static_cast<std::size_t>(lattice.cells[axis]) + per - 1) / per;
    };
    return 2 * sizeof(std::uint32_t) * kBlockWords * over(0, kBlockTiles) * over(1, 8) * over(2, 32);
  }

  std::int32_t depth() const { return static_cast<std::int32_t>(words_deep); }
  std::int32_t tile_rows() const { return static_cast<std::int32_t>(rows / words_deep); }
  /// Of a tile row, padding included.
  std::size_t row_words() const { return blocks * kBlockWords; }
  std::size_t row_offset(std::int32_t tile_row, std::int32_t word) const {
    return (static_cast<std::size_t>(tile_row) * words_deep + static_cast<std::size_t>(word)) * row_words();
  }

  /// To be called before tiles x in [from, to) of a tile row are drawn to; from < to.
  void mark(std::int32_t tile_row, std::int32_t word, std::int32_t from, std::int32_t to) {
    const std::size_t row = static_cast<std::size_t>(tile_row) * words_deep + static_cast<std::size_t>(word);
    const std::int32_t first = from / kBlockTiles, last = (to - 1) / kBlockTiles;
    for (std::int32_t i = first >> 6; i <= last >> 6; ++i) {
      std::uint64_t bits = i == last >> 6 ? ~0ull >> (63 - (last & 63)) : ~0ull;
      if (i == first >> 6) bits &= ~0ull << (first & 63);
      const std::size_t at = row * marks_per_row + static_cast<std::size_t>(i);
      bits &= ~marked[at];
      if (bits == 0) continue;
      marked[at] |= bits;
      used[at] |= bits;
      for (; bits != 0; bits &= bits - 1) {
        touch(row * blocks + static_cast<std::size_t>(i) * 64 + static_cast<std::size_t>(std::countr_zero(bits)));
      }
    }
  }
  /// What was drawn since the last keep() or undo() stays.
  void keep();
  /// And is undone. Only while `copying`.
  void undo();
  /// All counts become 0.
  void clear();

  bool overflowed() const {
    std::uint32_t any = 0;
    for (const std::uint32_t lane : overflow) any |= lane;
    return any != 0;
  }

  Lattice lattice;
  std::uint32_t words_deep;  // along z
  std::uint32_t blocks;      // of one tile row
  std::uint32_t rows;        // tile rows, times words_deep
  std::uint32_t marks_per_row;
  TileVector<std::uint32_t> planes;
  std::vector<std::uint64_t> marked, used;  // bits per block: since keep(), since clear()
  std::vector<std::uint32_t> touched;       // the marked blocks, in order of their marks
  TileVector<std::uint32_t> copies;         // of those, as they were; room for more
  bool copying = true;
  bool down = false;                             // parts are taken away
  alignas(32) std::uint32_t overflow[8] = {};    // voxels, by place in a tile, that were covered too often
  std::uint64_t hits = 0, outside = 0;           // as VoxelCanvas, of what was drawn

 private:
  void touch(std::size_t block) {
    if (copying) {
      const std::size_t at = touched.size() * kBlockWords;
      if (copies.size() < at + kBlockWords) copies.resize(2 * at + 64 * kBlockWords);
      std::memcpy(copies.data() + at, planes.data() + block * kBlockWords, kBlockWords * sizeof(std::uint32_t));
    }
    touched.push_back(static_cast<std::uint32_t>(block));
  }
};

}  // namespace espalier
