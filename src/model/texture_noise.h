#pragma once
// Noise that repeats: gradient noise and cells on lattices of whole periods, from integer hashes. Single precision and
// exactly rounded operations only, so that every CPU computes the same bits.

#include <cstdint>

#include "base/vec.h"

namespace espalier {

/// A hash of a lattice point, evenly spread over 32 bits.
std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::uint32_t seed);
/// The hash as a number in 0..1.
inline float unit_hash(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  return static_cast<float>(lattice_hash(x, y, seed) >> 8) * 0x1p-24f;
}

/// Periods of a lattice in cells, >= 1.
struct Periods {
  std::int32_t x = 1, y = 1;
};

/// i modulo n, never negative.
inline std::int32_t wrapped(std::int32_t i, std::int32_t n) {
  const std::int32_t rest = i % n;
  return rest < 0 ? rest + n : rest;
}

/// Gradient noise (Perlin 2002) in about -1..1 at a point in cells; repeats after `periods`.
float gradient_noise(Vec2 p, Periods periods, std::uint32_t seed);

/// Octaves of gradient noise, each of twice the frequency and half the strength, in about -1..1. `ridges` in 0..1 turns
/// them into ridges along their zeros.
float fractal_noise(Vec2 p, Periods periods, int octaves, std::uint32_t seed, float ridges = 0);

/// One point per cell of the lattice, anywhere in the middle `spread` of it; in cells.
Vec2 cell_point(std::int32_t x, std::int32_t y, Periods periods, float spread, std::uint32_t seed);

/// 0 below `low`, 1 above `high`, smooth between.
inline float smooth_step(float low, float high, float x) {
  const float t = (x - low) / (high - low);
  return t > 0 ? t < 1 ? t * t * (3 - 2 * t) : 1 : 0;
}
inline float mix_of(float a, float b, float t) { return a + (b - a) * t; }
inline Vec3 mix_of(const Vec3& a, const Vec3& b, float t) { return a + (b - a) * t; }
inline float clamped(float x) { return x > 0 ? x < 1 ? x : 1 : 0; }

}  // namespace espalier
