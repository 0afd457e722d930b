#pragma once
// Image: a picture in memory, 8-bit sRGB with alpha.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier {

struct Image {
  static constexpr std::uint32_t kMostSide = 16384;
  static constexpr std::uint64_t kMostPixels = 64ull << 20;

  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // rows from the top, rgba[4 * (x + width * y) + channel]; alpha not multiplied in

  std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) { return rgba.data() + 4 * (x + std::size_t{width} * y); }
  const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const {
    return rgba.data() + 4 * (x + std::size_t{width} * y);
  }
};

}  // namespace espalier
