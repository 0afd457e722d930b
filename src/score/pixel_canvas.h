#pragma once
// PixelCanvas: one bit per pixel of an image, in tiles that a SIMD register holds: 8 rows by 32 columns.
// words[(row / 8 * across + column / 32) * 8 + row % 8], bit 31 - column % 32; across = ceil(width / 32). Padding bits
// are never set; the number of tiles is a multiple of four.

#include <cstddef>
#include <cstdint>

#include "score/bit_grid.h"

namespace espalier {

struct PixelCanvas {
  PixelCanvas() = default;
  PixelCanvas(std::uint32_t width_in, std::uint32_t height_in)
      : width(width_in), height(height_in), across((width_in + 31) / 32),
        words((std::size_t{across} * ((height_in + 7) / 8) + 3) / 4 * 32) {}

  std::size_t tiles() const { return words.size() / 8; }
  std::size_t word_index(std::uint32_t column, std::uint32_t row) const {
    return (std::size_t{row / 8} * across + column / 32) * 8 + row % 8;
  }
  static std::uint32_t bit(std::uint32_t column) { return 0x80000000u >> column % 32; }
  bool get(std::uint32_t column, std::uint32_t row) const {
    return (words[word_index(column, row)] & bit(column)) != 0;
  }
  void set(std::uint32_t column, std::uint32_t row) { words[word_index(column, row)] |= bit(column); }

  std::uint32_t width = 0, height = 0, across = 0;
  TileVector<std::uint32_t> words;
};

}  // namespace espalier
