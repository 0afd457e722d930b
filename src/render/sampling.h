#pragma once
// Sampling: where in a pixel, on a light and over a hemisphere the samples of a pixel go. Additive recurrences in the
// generalised golden ratio (Roberts 2018): any few in a row are evenly spread. Pixels count on along the Morton curve,
// so that neighbours complement each other and smoothing over them leaves little noise. Integers until the last step.
// What is drawn from them for lights comes from tables, which begin anew after a square of 32 x 32 pixels.

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/vec.h"

namespace espalier {

class PixelSamples {
 public:
  PixelSamples(std::uint32_t x, std::uint32_t y) : first_(kPerPixel * (spread(x) | spread(y) << 1)) {}

  Vec2 in_pixel(std::uint32_t s) const { return pair(s, 0xc13fa9aau, 0x91e10da6u); }
  /// The number of a sample among all, for LightTables.
  std::uint32_t number(std::uint32_t s) const { return first_ + s; }

 private:
  friend class LightTables;
  static constexpr std::uint32_t kPerPixel = 4;

  static Vec2 pair(std::uint32_t n, std::uint32_t step_u, std::uint32_t step_v) {
    return {unit(0x80000000u + n * step_u), unit(0x80000000u + n * step_v)};
  }
  static float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
  /// The low 16 bits, a zero after each.
  static std::uint32_t spread(std::uint32_t x) {
    x &= 0xffff;
    x = (x | x << 8) & 0x00ff00ff;
    x = (x | x << 4) & 0x0f0f0f0f;
    x = (x | x << 2) & 0x33333333;
    return (x | x << 1) & 0x55555555;
  }

  std::uint32_t first_;
};

/// Uniform on the unit disc for u uniform on the unit square; neighbours stay neighbours (Shirley and Chiu 1997).
inline Vec2 on_disc(const Vec2& u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = a * a > b * b;
  const float radius = wide ? a : b;
  const float quarter = static_cast<float>(kPi / 4);
  const float angle = wide ? quarter * (b / a) : 2 * quarter - quarter * (a / b);
  return {radius * cosine(angle), radius * sine(angle)};
}

/// Two unit vectors that make a right-handed basis with the unit vector n (Duff et al. 2017).
inline void complete_basis(const Vec3& n, Vec3& b1, Vec3& b2) {
  const float sign = n.z < 0 ? -1.0f : 1.0f, a = -1 / (sign + n.z), b = n.x * n.y * a;
  b1 = Vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  b2 = Vec3(b, sign + n.y * n.y * a, -n.y);
}

/// Points and directions by a sample's number.
class LightTables {
 public:
  static constexpr std::uint32_t kSize = 4096;
  static const LightTables& shared();

  /// On the unit disc.
  Vec2 on_light(std::uint32_t number) const { return light_[number % kSize]; }
  Vec2 in_lobe(std::uint32_t number) const { return lobe_[number % kSize]; }
  /// A direction about the unit vector n with density cosine / pi.
  Vec3 over_hemisphere(const Vec3& n, std::uint32_t number) const {
    const Vec3& d = hemisphere_[number % kSize];
    Vec3 b1, b2;
    complete_basis(n, b1, b2);
    return d.x * b1 + d.y * b2 + d.z * n;
  }

 private:
  LightTables();

  Vec2 light_[kSize], lobe_[kSize];
  Vec3 hemisphere_[kSize];
};

/// The direction within a cone about the unit vector `axis`, whose half angle has the tangent `spread`, at `d` of the
/// disc.
inline Vec3 in_cone(const Vec3& axis, float spread, const Vec2& d) {
  Vec3 b1, b2;
  complete_basis(axis, b1, b2);
  const float x = spread * d.x, y = spread * d.y;
  return (1 / std::sqrt(1 + x * x + y * y)) * (axis + x * b1 + y * b2);
}

}  // namespace espalier
