#include "model/texture_noise.h"

#include <cmath>

namespace espalier {
namespace {

/// Quintic ease: no kinks in the second derivative at the lattice lines.
float eased(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// The dot product of a lattice point's gradient, one of 16 directions, with the way from it.
float slope(std::int32_t x, std::int32_t y, std::uint32_t seed, float dx, float dy) {
  constexpr float kDirections[8][2] = {{1, 0},          {0.9238795f, 0.3826834f},  {0.7071068f, 0.7071068f},
                                       {0.3826834f, 0.9238795f}, {0, 1},           {-0.3826834f, 0.9238795f},
                                       {-0.7071068f, 0.7071068f}, {-0.9238795f, 0.3826834f}};
  const std::uint32_t hash = lattice_hash(x, y, seed);
  const float(&direction)[2] = kDirections[hash >> 8 & 7];
  const float along = direction[0] * dx + direction[1] * dy;
  return hash & 0x1000 ? -along : along;
}

}  // namespace

std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  // The finaliser of MurmurHash3 (Appleby 2011) after multiplying the coordinates apart.
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                    (seed + 0x9e3779b9u) * 0xcb1ab31fu;
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

float gradient_noise(Vec2 p, Periods periods, std::uint32_t seed) {
  const float fx = std::floor(p.x), fy = std::floor(p.y);
  const std::int32_t x = wrapped(static_cast<std::int32_t>(fx), periods.x), x1 = x + 1 < periods.x ? x + 1 : 0;
  const std::int32_t y = wrapped(static_cast<std::int32_t>(fy), periods.y), y1 = y + 1 < periods.y ? y + 1 : 0;
  const float dx = p.x - fx, dy = p.y - fy, ex = eased(dx), ey = eased(dy);
  const float low = mix_of(slope(x, y, seed, dx, dy), slope(x1, y, seed, dx - 1, dy), ex);
  const float high = mix_of(slope(x, y1, seed, dx, dy - 1), slope(x1, y1, seed, dx - 1, dy - 1), ex);
  return 1.5f * mix_of(low, high, ey);
}

float fractal_noise(Vec2 p, Periods periods, int octaves, std::uint32_t seed, float ridges) {
  float sum = 0, strength = 1, total = 0;
  for (int octave = 0; octave < octaves; ++octave) {
    const float plain = gradient_noise(p, periods, seed + static_cast<std::uint32_t>(octave));
    const float ridge = 1 - 2.6f * std::abs(plain);
    sum += strength * mix_of(plain, ridge, ridges);
    total += strength;
    strength *= 0.5f;
    p *= 2.0f;
    periods = {2 * periods.x, 2 * periods.y};
  }
  return total > 0 ? 1.4f * sum / total : 0;
}

Vec2 cell_point(std::int32_t x, std::int32_t y, Periods periods, float spread, std::uint32_t seed) {
  const std::uint32_t hash = lattice_hash(wrapped(x, periods.x), wrapped(y, periods.y), seed);
  const float u = static_cast<float>(hash & 0xffff) * 0x1p-16f, v = static_cast<float>(hash >> 16) * 0x1p-16f;
  return {static_cast<float>(x) + 0.5f + spread * (u - 0.5f), static_cast<float>(y) + 0.5f + spread * (v - 0.5f)};
}

}  // namespace espalier
