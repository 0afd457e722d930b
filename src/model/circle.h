#pragma once
// Points around a circle, the same bits on every CPU.

#include <cstdint>

namespace espalier {

struct CirclePoint {
  double cos, sin;
};

/// The point i / n around the unit circle, i <= n. Exactly symmetric where n is a multiple of 4.
CirclePoint circle_point(std::uint32_t i, std::uint32_t n);

}  // namespace espalier
