#pragma once
// Float4: four floats at once with exact IEEE operations only (no reciprocal estimates), so that every CPU computes the
// same bits. SSE2, which every x86-64 has; plain loops elsewhere.

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace espalier {

#if defined(__SSE2__)

struct Float4 {
  __m128 v;

  explicit Float4(float x) : v(_mm_set1_ps(x)) {}
  explicit Float4(__m128 x) : v(x) {}
  static Float4 load(const float* aligned) { return Float4(_mm_load_ps(aligned)); }
  static Float4 load_any(const float* p) { return Float4(_mm_loadu_ps(p)); }
  void store(float* aligned) const { _mm_store_ps(aligned, v); }
};

inline Float4 operator+(Float4 a, Float4 b) { return Float4(_mm_add_ps(a.v, b.v)); }
inline Float4 operator-(Float4 a, Float4 b) { return Float4(_mm_sub_ps(a.v, b.v)); }
inline Float4 operator*(Float4 a, Float4 b) { return Float4(_mm_mul_ps(a.v, b.v)); }
inline Float4 operator/(Float4 a, Float4 b) { return Float4(_mm_div_ps(a.v, b.v)); }
inline Float4 smaller(Float4 a, Float4 b) { return Float4(_mm_min_ps(a.v, b.v)); }
inline Float4 larger(Float4 a, Float4 b) { return Float4(_mm_max_ps(a.v, b.v)); }
/// Bit k: a[k] <= b[k]; false where either is NaN.
inline unsigned less_equal(Float4 a, Float4 b) {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.v, b.v)));
}
/// Lanes of all bits where a >= b; for any() and where().
inline Float4 at_least(Float4 a, Float4 b) { return Float4(_mm_cmpge_ps(a.v, b.v)); }
inline bool any(Float4 mask) { return _mm_movemask_ps(mask.v) != 0; }
/// x where the mask is set, else 0.
inline Float4 where(Float4 mask, Float4 x) { return Float4(_mm_and_ps(mask.v, x.v)); }

#else

struct Float4 {
  float v[4];

  Float4() = default;
  explicit Float4(float x) : v{x, x, x, x} {}
  static Float4 load(const float* p) {
    Float4 r;
    for (int k = 0; k < 4; ++k) r.v[k] = p[k];
    return r;
  }
  static Float4 load_any(const float* p) { return load(p); }
  void store(float* p) const {
    for (int k = 0; k < 4; ++k) p[k] = v[k];
  }
};

template <typename Op>
Float4 each(Float4 a, Float4 b, Op op) {
  for (int k = 0; k < 4; ++k) a.v[k] = op(a.v[k], b.v[k]);
  return a;
}
inline Float4 operator+(Float4 a, Float4 b) { return each(a, b, [](float x, float y) { return x + y; }); }
inline Float4 operator-(Float4 a, Float4 b) { return each(a, b, [](float x, float y) { return x - y; }); }
inline Float4 operator*(Float4 a, Float4 b) { return each(a, b, [](float x, float y) { return x * y; }); }
inline Float4 operator/(Float4 a, Float4 b) { return each(a, b, [](float x, float y) { return x / y; }); }
inline Float4 smaller(Float4 a, Float4 b) { return each(a, b, [](float x, float y) { return x < y ? x : y; }); }
inline Float4 larger(Float4 a, Float4 b) { return each(a, b, [](float x, float y) { return x > y ? x : y; }); }
inline unsigned less_equal(Float4 a, Float4 b) {
  unsigned mask = 0;
  for (int k = 0; k < 4; ++k) mask |= (a.v[k] <= b.v[k] ? 1u : 0u) << k;
  return mask;
}
inline Float4 at_least(Float4 a, Float4 b) { return each(a, b, [](float x, float y) { return x >= y ? 1.0f : 0.0f; }); }
inline bool any(Float4 mask) { return mask.v[0] + mask.v[1] + mask.v[2] + mask.v[3] > 0; }
inline Float4 where(Float4 mask, Float4 x) { return each(mask, x, [](float m, float y) { return m > 0 ? y : 0.0f; }); }

#endif

}  // namespace espalier
