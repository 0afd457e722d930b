#pragma once
// The sRGB transfer curve (IEC 61966-2-1) by arithmetic whose bits do not depend on the CPU.

#include <cmath>
#include <cstdint>

namespace espalier {

/// x^(1/2.4) = (x^5)^(1/12) for x in (0, 1], by Newton's method for the cube root and two square roots.
inline double root_2_4(double x) {
  const double cube = x * x * x * x * x;
  double root = x;  // above the root of x^5 (x <= 1), from where Newton's method descends
  for (int i = 0; i < 60; ++i) {
    const double next = (2 * root + cube / (root * root)) / 3;
    if (!(next < root)) break;
    root = next;
  }
  return std::sqrt(std::sqrt(root));
}

/// The sRGB value in 0..1 of a linear-light value, which is clamped to 0..1 first; NaN gives 0.
inline double srgb_from_linear(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * root_2_4(linear) - 0.055;
}

inline std::uint8_t srgb_byte(double linear) { return static_cast<std::uint8_t>(255 * srgb_from_linear(linear) + 0.5); }

}  // namespace espalier
