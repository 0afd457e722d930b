#pragma once
// Sampling: where in a pixel, on a light and over a hemisphere the samples of a pixel go. Additive recurrences in the
// generalised golden ratio (Roberts 2018), shifted per pixel by a hash: any first few of them are evenly spread, and
// all is integer arithmetic until the last step.

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "base/hash.h"
#include "base/math.h"
#include "base/vec.h"

namespace espalier {

using Vec2 = glm::vec2;

class PixelSamples {
 public:
  PixelSamples(std::uint32_t x, std::uint32_t y) : key_(std::uint64_t{y} << 32 | x) {}

  Vec2 in_pixel(std::uint32_t s) const { return pair(s, 0, 0xc13fa9aau, 0x91e10da6u); }
  Vec2 on_light(std::uint32_t s) const { return pair(s, 1, 0xdb4f0b91u, 0xbbe05635u); }
  Vec2 over_hemisphere(std::uint32_t s) const { return pair(s, 2, 0xa0f2ec76u, 0x89e18286u); }
  Vec2 in_lobe(std::uint32_t s) const { return pair(s, 3, 0x89e18286u, 0xdb4f0b91u); }

 private:
  Vec2 pair(std::uint32_t s, std::uint64_t purpose, std::uint32_t step_u, std::uint32_t step_v) const {
    const std::uint64_t shift = scatter(key_ * 4 + purpose + 1);
    return {unit(static_cast<std::uint32_t>(shift) + s * step_u),
            unit(static_cast<std::uint32_t>(shift >> 32) + s * step_v)};
  }
  static float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

  std::uint64_t key_;
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

/// A direction about n with density cosine / pi.
inline Vec3 cosine_hemisphere(const Vec3& n, const Vec2& u) {
  const Vec2 d = on_disc(u);
  Vec3 b1, b2;
  complete_basis(n, b1, b2);
  const float up = 1 - d.x * d.x - d.y * d.y;
  return d.x * b1 + d.y * b2 + (up > 0 ? std::sqrt(up) : 0.0f) * n;
}

/// A direction within a cone about the unit vector `axis`; `spread` is the tangent of its half angle.
inline Vec3 in_cone(const Vec3& axis, float spread, const Vec2& u) {
  const Vec2 d = spread * on_disc(u);
  Vec3 b1, b2;
  complete_basis(axis, b1, b2);
  return glm::normalize(axis + d.x * b1 + d.y * b2);
}

}  // namespace espalier
