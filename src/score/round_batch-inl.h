// Setting up four spheres, or four cylinders and cones, at once; see part_batch-inl.h. Included once per target.

#if defined(ESPALIER_SCORE_ROUND_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_ROUND_BATCH_INL_H
#undef ESPALIER_SCORE_ROUND_BATCH_INL_H
#else
#define ESPALIER_SCORE_ROUND_BATCH_INL_H
#endif

#include "score/part_batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

/// e1, e2: with z's direction u in local space three axes at right angles; only e1 changes along x. All of unit length.
HWY_INLINE void PartBatch::sphere_axes(const D4 u[3], D4 e1[3], D4 e2[3]) const {
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    e2[k] = u[k1] * l_[k2][0] - u[k2] * l_[k1][0];
  }
  const D4 scale = number(1) / square_root(e2[0] * e2[0] + e2[1] * e2[1] + e2[2] * e2[2]);
  for (int k = 0; k < 3; ++k) e2[k] = e2[k] * scale;
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    e1[k] = e2[k1] * u[k2] - e2[k2] * u[k1];
  }
}

HWY_INLINE void PartBatch::set_spheres(const Lattice& lattice) {
  D4 extent[3];
  for (int i = 0; i < 3; ++i) {
    extent[i] = number(0.5) * square_root(m_[i][0] * m_[i][0] + m_[i][1] * m_[i][1] + m_[i][2] * m_[i][2]);
  }
  set_reach(lattice, o_, extent);
  // See SpanForm::set_sphere; l is the adjugate here, so that everything but `half` is free of its scale, det.
  const D4 s = number(1) / square_root(l_[0][2] * l_[0][2] + l_[1][2] * l_[1][2] + l_[2][2] * l_[2][2]);
  const D4 u[3] = {l_[0][2] * s, l_[1][2] * s, l_[2][2] * s};
  D4 e1[3], e2[3], middle[3], across[3], side[3];
  sphere_axes(u, e1, e2);
  for (int k = 0; k < 3; ++k) {
    const D4 p[3] = {k < 2 ? l_[0][k] : t_[0], k < 2 ? l_[1][k] : t_[1], k < 2 ? l_[2][k] : t_[2]};
    middle[k] = -s * (u[0] * p[0] + u[1] * p[1] + u[2] * p[2]);
    across[k] = s * (e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2]);
    side[k] = s * (e2[0] * p[0] + e2[1] * p[1] + e2[2] * p[2]);
  }
  const D4 half = number(0.5) * magnitude(det_ * s);  // of the row through the centre
  set_depth(kMiddle, middle[0], middle[1], middle[2]);
  set_linear(kAcross, {across[0], across[1], across[2]});
  store_floats(side[1], values_[kSide]);
  store_floats(side[2], values_[kSide + 1]);
  store_floats(half * half, values_[kMost]);
  const D4 inverse = number(1) / across[0], at = -across[2] * inverse, wide = half * magnitude(inverse);
  set_band(0, -across[1] * inverse, at - wide, at + wide);
  finish();
}

/// Places cylinders and cones; sets extent (half their boxes), radius and taper.
HWY_INLINE void PartBatch::place_rounds(const Lattice& lattice, const Instance* const part[4], bool tapered,
                                        RoundSize& size) {
  const D4 half = number(0.5);
  D4 top = number(1);
  if (tapered) {
    alignas(32) double tops[4];
    for (int lane = 0; lane < 4; ++lane) tops[lane] = double{part[lane]->top};
    top = D4::load(tops);
    ok_ = ok_ & less(magnitude(top), number(1e6));
    top = larger(top, number(0));
  }
  size.radius = number(0.25) * (number(1) + top);
  size.taper = half * (top - number(1));
  D4 centre[3];
  for (int i = 0; i < 3; ++i) {  // the hull of two discs
    const D4 across = half * square_root(m_[i][0] * m_[i][0] + m_[i][2] * m_[i][2]), up = half * m_[i][1];
    const D4 high = larger(top * across + up, across - up), low = smaller(up - top * across, -up - across);
    centre[i] = o_[i] + half * (high + low);
    size.extent[i] = half * (high - low);
  }
  set_reach(lattice, centre, size.extent);
  const D4 scale = number(1) / det_;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) l_[j][i] = l_[j][i] * scale;
    t_[j] = t_[j] * scale;
  }
}

HWY_INLINE RoundForms PartBatch::round_forms(const RoundSize& size) const {
  RoundForms f;
  f.rz = size.taper * l_[1][2];
  const D4 g = square_root(l_[0][2] * l_[0][2] + l_[2][2] * l_[2][2]), gz = magnitude(f.rz);
  f.square = (g - gz) * (g + gz);
  const D4 inverse = number(1) / f.square, steep = magnitude(inverse), root = square_root(steep);
  const D4 over_g = number(1) / g, dx = l_[0][2] * over_g, dz = l_[2][2] * over_g;
  for (int k = 0; k < 3; ++k) {
    const D4 x = k < 2 ? l_[0][k] : t_[0], y = k < 2 ? l_[1][k] : t_[1], z = k < 2 ? l_[2][k] : t_[2];
    const D4 r = k < 2 ? size.taper * y : size.taper * y + size.radius;
    const D4 u = x * dx + z * dz;
    f.middle[k] = (f.rz * r - g * u) * inverse;
    f.along[k] = (g * r - f.rz * u) * steep;
    f.across[k] = (z * dx - x * dz) * root;
  }
  return f;
}

/// As SpanForm::well_conditioned; rows along the axis of a cylinder are left to it too.
HWY_INLINE void PartBatch::require_good_forms(const RoundSize& size, const RoundForms& f) {
  const D4 span = span_, square = magnitude(f.square);
  const D4 m = magnitude(f.middle[0]) * size.extent[0] + magnitude(f.middle[1]) * size.extent[1] +
               magnitude(f.middle[2]) + span;
  const D4 h = magnitude(f.along[0]) * size.extent[0] + magnitude(f.along[1]) * size.extent[1] + magnitude(f.along[2]);
  const D4 per_x = l_[0][0] * l_[0][0] + l_[0][1] * l_[0][1] + l_[0][2] * l_[0][2];
  const D4 per_z = l_[2][0] * l_[2][0] + l_[2][1] * l_[2][1] + l_[2][2] * l_[2][2];
  const D4 taper = magnitude(size.taper), widest = size.radius + number(0.5) * taper;
  const D4 straight = less(taper, number(1e-300));
  const D4 good = less(m * h * square, number(kWorstCondition) * widest * square_root(smaller(per_x, per_z)));
  const D4 along_axis = l_[0][2] * l_[0][2] + l_[2][2] * l_[2][2];
  ok_ = ok_ & (straight | good) & less(number(1e-14), along_axis * span * span) & less(number(1e-15), square);
}

HWY_INLINE void PartBatch::set_rounds(const Lattice& lattice, const Instance* const part[4], bool tapered) {
  RoundSize size;
  place_rounds(lattice, part, tapered, size);
  set_slab(0, l_[1][0], l_[1][1], l_[1][2], t_[1], number(1));
  const RoundForms f = round_forms(size);
  require_good_forms(size, f);
  set_depth(kMiddle, f.middle[0], f.middle[1], f.middle[2]);
  set_linear(kAlong, {f.along[0], f.along[1], f.along[2]});
  set_linear(kAcross, {f.across[0], f.across[1], f.across[2]});
  // A lens lies between the lines across = +-along.
  const D4 lens = less(number(0), f.square), far = number(1e6);
  for (int k = 0; k < 2; ++k) {
    D4 c[3];
    for (int i = 0; i < 3; ++i) c[i] = (k == 0 ? f.across[i] : -f.across[i]) - f.along[i];
    const D4 inverse = number(-1) / c[0], at = c[2] * inverse;
    const D4 below = less(number(0), c[0]) & lens, above = less(c[0], number(0)) & lens;
    set_band(k, c[1] * inverse, choose(above, at, -far), choose(below, at, far));
  }
  alignas(32) double lens_mask[4], up_mask[4];
  lens.store(lens_mask);
  less(number(0), f.rz).store(up_mask);
  for (int lane = 0; lane < 4; ++lane) {
    lens_[lane] = lens_mask[lane] != 0;
    up_[lane] = up_mask[lane] != 0;
  }
  finish();
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
