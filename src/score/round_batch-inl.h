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

HWY_INLINE void PartBatch::set_spheres(const Lattice& lattice) {
  D4 extent[3];
  for (int i = 0; i < 3; ++i) {
    extent[i] = number(0.5) * square_root(m_[i][0] * m_[i][0] + m_[i][1] * m_[i][1] + m_[i][2] * m_[i][2]);
  }
  set_reach(lattice, o_, extent);
  // All directions scaled by det: s = det / |z|. See SpanForm::set_sphere.
  const D4 u[3] = {l_[0][2], l_[1][2], l_[2][2]};
  const D4 s = number(1) / square_root(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  const D4 un[3] = {u[0] * s, u[1] * s, u[2] * s};
  D4 e2[3], e1[3];
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    e2[k] = un[k1] * l_[k2][0] - un[k2] * l_[k1][0];
  }
  const D4 e = number(1) / square_root(e2[0] * e2[0] + e2[1] * e2[1] + e2[2] * e2[2]);
  for (int k = 0; k < 3; ++k) e2[k] = e2[k] * e;
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    e1[k] = e2[k1] * un[k2] - e2[k2] * un[k1];
  }
  D4 mid[3], one[3], two[3];
  for (int k = 0; k < 3; ++k) {
    const D4 p[3] = {k < 2 ? l_[0][k] : t_[0], k < 2 ? l_[1][k] : t_[1], k < 2 ? l_[2][k] : t_[2]};
    mid[k] = -s * (un[0] * p[0] + un[1] * p[1] + un[2] * p[2]);
    one[k] = s * (e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2]);
    two[k] = s * (e2[0] * p[0] + e2[1] * p[1] + e2[2] * p[2]);
  }
  const D4 half = number(0.5) * magnitude(det_ * s);  // of the row through the centre
  set_depth(kMiddle, mid[0], mid[1], mid[2]);
  set_linear(kAcross, {one[0], one[1], one[2]});
  store_floats(two[1], values_[kSide]);
  store_floats(two[2], values_[kSide + 1]);
  store_floats(half * half, values_[kMost]);
  const D4 inverse = number(1) / one[0];
  set_band(0, -one[1] * inverse, -one[2] * inverse - half * magnitude(inverse),
           -one[2] * inverse + half * magnitude(inverse));
  finish();
}

HWY_INLINE void PartBatch::set_rounds(const Lattice& lattice, const Instance* const part[4], bool tapered) {
  D4 top = number(1);
  if (tapered) {
    alignas(32) double tops[4];
    for (int lane = 0; lane < 4; ++lane) tops[lane] = double{part[lane]->top};
    top = D4::load(tops);
    ok_ = ok_ & less(magnitude(top), number(1e6));
    top = larger(top, number(0));
  }
  const D4 half = number(0.5), radius = number(0.25) * (number(1) + top), taper = half * (top - number(1));
  D4 centre[3], extent[3];
  for (int i = 0; i < 3; ++i) {
    const D4 across = half * square_root(m_[i][0] * m_[i][0] + m_[i][2] * m_[i][2]), up = half * m_[i][1];
    const D4 high = larger(top * across + up, across - up), low = smaller(up - top * across, -up - across);
    centre[i] = o_[i] + half * (high + low);
    extent[i] = half * (high - low);
  }
  set_reach(lattice, centre, extent);
  const D4 scale = number(1) / det_;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) l_[j][i] = l_[j][i] * scale;
    t_[j] = t_[j] * scale;
  }
  set_slab(0, l_[1][0], l_[1][1], l_[1][2], t_[1], number(1));

  // See SpanForm::set_round.
  const D4 rz = taper * l_[1][2];
  const D4 g = square_root(l_[0][2] * l_[0][2] + l_[2][2] * l_[2][2]), ga = magnitude(rz);
  const D4 a = (g - ga) * (g + ga), size = magnitude(a), over_a = number(1) / a, over_size = magnitude(over_a);
  const D4 root = square_root(over_size), over_g = number(1) / g;
  const D4 dx = l_[0][2] * over_g, dz = l_[2][2] * over_g;
  ok_ = ok_ & less(number(1e-7), g * span_) & less(number(1e-15), size);
  D4 mid[3], p[3], v[3];
  for (int k = 0; k < 3; ++k) {
    const D4 x = k < 2 ? l_[0][k] : t_[0], y = k < 2 ? l_[1][k] : t_[1], z = k < 2 ? l_[2][k] : t_[2];
    const D4 r = k < 2 ? taper * y : taper * y + radius;
    const D4 u = x * dx + z * dz;
    mid[k] = (rz * r - g * u) * over_a;
    p[k] = (g * r - rz * u) * over_size;
    v[k] = (z * dx - x * dz) * root;
  }
  const D4 m = magnitude(mid[0]) * extent[0] + magnitude(mid[1]) * extent[1] + magnitude(mid[2]) + span_;
  const D4 h = magnitude(p[0]) * extent[0] + magnitude(p[1]) * extent[1] + magnitude(p[2]);
  const D4 per_x = l_[0][0] * l_[0][0] + l_[0][1] * l_[0][1] + l_[0][2] * l_[0][2];
  const D4 per_z = l_[2][0] * l_[2][0] + l_[2][1] * l_[2][1] + l_[2][2] * l_[2][2];
  const D4 widest = radius + half * magnitude(taper);
  const D4 straight = less(magnitude(taper), number(1e-300));
  ok_ = ok_ & (straight | less(m * h * size, number(300) * widest * square_root(smaller(per_x, per_z))));

  set_depth(kMiddle, mid[0], mid[1], mid[2]);
  set_linear(kAlong, {p[0], p[1], p[2]});
  set_linear(kAcross, {v[0], v[1], v[2]});
  // A lens lies between the lines across = +-along.
  const D4 lens = less(number(0), a), far = number(1e6);
  for (int k = 0; k < 2; ++k) {
    const D4 ca = k == 0 ? v[0] - p[0] : -v[0] - p[0], cb = k == 0 ? v[1] - p[1] : -v[1] - p[1];
    const D4 cc = k == 0 ? v[2] - p[2] : -v[2] - p[2];
    const D4 inverse = number(-1) / ca, at = cc * inverse, below = less(number(0), ca) & lens;
    const D4 above = less(ca, number(0)) & lens;
    set_band(k, cb * inverse, choose(above, at, -far), choose(below, at, far));
  }
  lens.store(lens_mask_);
  less(number(0), rz).store(up_mask_);
  for (int lane = 0; lane < 4; ++lane) {
    lens_[lane] = lens_mask_[lane] != 0;
    up_[lane] = up_mask_[lane] != 0;
  }
  finish();
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
