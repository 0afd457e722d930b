// The rows of convex shapes, eight at a time: each form gives, for one x, the depths [f_high, f_low) that its part
// covers in the eight rows of a tile (see span_form.h). Included once per target.

#if defined(ESPALIER_SCORE_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_SPANS_INL_H
#undef ESPALIER_SCORE_SPANS_INL_H
#else
#define ESPALIER_SCORE_SPANS_INL_H
#endif

#include "score/eight-inl.h"
#include "score/span_form.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

inline constexpr float kNever = 1e9f;  // a depth below everything: no row of a model reaches there

struct Span {
  F8 low, high;
};

/// A linear form along x for eight given rows.
struct LinearRow {
  F8 a, base;

  HWY_INLINE void set(const LinearForm& form, const F8& y) {
    a = F8::all(form.a);
    base = F8::all(form.b) * y + F8::all(form.c);
  }
  HWY_INLINE F8 at(const F8& x) const { return a * x + base; }
};

/// Boxes and what else lies between pairs of parallel planes.
template <int kSlabs>
struct SlabRow {
  LinearRow slab[kSlabs];
  F8 width[kSlabs];

  template <class Form>
  HWY_INLINE void set(const Form& form, const F8& y) {
    for (int s = 0; s < kSlabs; ++s) {
      slab[s].set(form.slab(s), y);
      width[s] = F8::all(form.width(s));
    }
  }
  HWY_INLINE Span at(const F8& x) const {
    Span span;
    span.low = slab[0].at(x);
    span.high = span.low - width[0];
    for (int s = 1; s < kSlabs; ++s) {
      const F8 low = slab[s].at(x);
      span.low = smaller(span.low, low);
      span.high = larger(span.high, low - width[s]);
    }
    return span;
  }
};

struct PlaneRow {
  LinearRow plane[Solid::kMostPlanes + 2];
  int lowers, all;

  template <class Form>
  HWY_INLINE void set(const Form& form, const F8& y) {
    lowers = form.lowers();
    all = form.lowers() + form.uppers();
    for (int i = 0; i < all; ++i) plane[i].set(form.plane(i), y);
  }
  HWY_INLINE Span at(const F8& x) const {
    Span span{F8::all(kNever), F8::all(-kNever)};
    for (int i = 0; i < lowers; ++i) span.low = smaller(span.low, plane[i].at(x));
    for (int i = lowers; i < all; ++i) span.high = larger(span.high, plane[i].at(x));
    return span;
  }
};

struct SphereRow {
  LinearRow middle, across;
  F8 rest;

  template <class Form>
  HWY_INLINE void set(const Form& form, const F8& y) {
    middle.set(form.middle(), y);
    across.set(form.across(), y);
    const F8 side = F8::all(form.side().b) * y + F8::all(form.side().c);
    rest = F8::all(form.most()) - side * side;
  }
  HWY_INLINE Span at(const F8& x) const {
    const F8 m = middle.at(x), v = across.at(x);
    const F8 h = square_root(larger(rest - v * v, F8::all(0)));  // 0 beside the sphere: an empty span
    return {m + h, m - h};
  }
};

/// Cylinders and cones between their caps.
template <Quadric kQuadric>
struct RoundRow {
  LinearRow middle, along, across, slab;
  F8 width;

  template <class Form>
  HWY_INLINE void set(const Form& form, const F8& y) {
    middle.set(form.middle(), y);
    along.set(form.along(), y);
    across.set(form.across(), y);
    slab.set(form.slab(0), y);
    width = F8::all(form.width(0));
  }
  HWY_INLINE Span at(const F8& x) const {
    const F8 m = middle.at(x), p = along.at(x), v = across.at(x), low = slab.at(x);
    Span span{low, low - width};
    if constexpr (kQuadric == Quadric::lens) {
      const F8 h = square_root(larger(p * p - v * v, F8::all(0)));  // 0 beside the cone: an empty span
      span.low = smaller(span.low, m + h);
      span.high = larger(span.high, m - h);
    } else {
      const F8 h = square_root(p * p + v * v);
      if constexpr (kQuadric == Quadric::up) span.low = smaller(span.low, m - h);
      else span.high = larger(span.high, m + h);
    }
    return span;
  }
};

/// Bounds of x, row by row: pushes f_high out of reach where x is not between them.
struct LimitRow {
  F8 low, high;

  template <class Form>
  HWY_INLINE void set(const Form& form, std::int32_t first) {
    alignas(32) float from[8], to[8];
    form.row_limits(first, from, to);
    low = F8::load(from);
    high = F8::load(to);
  }
  HWY_INLINE F8 apply(const F8& f_high, const F8& x) const {
    const F8 steep = F8::all(0x1p30f);  // limits are half-integers: at least 2^29 on one side, below -2^29 on the other
    return larger(f_high, larger((low - x) * steep, (x - high) * steep));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
