// Setting up four parts at once: boxes, spheres, or cylinders and cones, the same formulas as ConvexShape and SpanForm
// with one part per lane. Parts that need care (limits, ill-conditioned, huge, flat, not finite) are left to those: a
// batch says for each lane whether it is ready, covers nothing, or must go the slow way. Included once per target.

#if defined(ESPALIER_SCORE_PART_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_PART_BATCH_INL_H
#undef ESPALIER_SCORE_PART_BATCH_INL_H
#else
#define ESPALIER_SCORE_PART_BATCH_INL_H
#endif

#include "score/eight-inl.h"
#include "score/lattice.h"
#include "score/span_form.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

HWY_INLINE D4 number(double v) { return D4::all(v); }

struct D4Linear {
  D4 a, b, c;
};

/// Half the box, radius at the middle, and radius per height of cylinders and cones.
struct RoundSize {
  D4 extent[3], radius, taper;
};

/// What SpanForm::set_round finds: middle, along and across as (x, y, 1) coefficients, <d,d> and the radius' slope.
struct RoundForms {
  D4 middle[3], along[3], across[3];
  D4 square, rz;
};

/// Four parts of one kind, and what was found out about them.
class PartBatch {
 public:
  // Rows of values_, one float per part.
  static constexpr int kSlab = 0;      // 3 x (a, b, c, width)
  static constexpr int kMiddle = 4, kAlong = 7, kAcross = 10, kSide = 13, kMost = 15;  // round shapes: after slab 0
  static constexpr int kBand = 16;     // 3 x (slope, low, high)
  static constexpr int kTop = 25, kBottom = 26, kRows = 27;

  HWY_INLINE void load(const Lattice& lattice, const Instance* const part[4]);
  HWY_INLINE void set_boxes(const Lattice& lattice);
  HWY_INLINE void set_spheres(const Lattice& lattice);
  HWY_INLINE void set_rounds(const Lattice& lattice, const Instance* const part[4], bool tapered);

  bool ready(int lane) const { return ready_[lane]; }
  bool empty(int lane) const {  // reaches no lattice point of the window
    return reach_[0][lane] >= reach_[3][lane] || reach_[1][lane] >= reach_[4][lane] ||
           reach_[2][lane] >= reach_[5][lane];
  }
  /// Round parts: Quadric::lens, else up or down.
  bool lens(int lane) const { return lens_[lane]; }
  bool up(int lane) const { return up_[lane]; }
  float value(int row, int lane) const { return values_[row][lane]; }
  std::int32_t reach(int row, int lane) const { return static_cast<std::int32_t>(reach_[row][lane]); }
  std::int32_t origin(int axis, int lane) const { return static_cast<std::int32_t>(origin_[axis][lane]); }

 private:
  HWY_INLINE void set_reach(const Lattice& lattice, const D4 centre[3], const D4 extent[3]);
  HWY_INLINE void set_slab(int index, const D4& nx, const D4& ny, const D4& nz, const D4& offset, const D4& size);
  HWY_INLINE void set_linear(int row, const D4Linear& f) {
    store_floats(f.a, values_[row]);
    store_floats(f.b, values_[row + 1]);
    store_floats(f.c, values_[row + 2]);
  }
  /// The depth of the plane z = a x + b y + c.
  HWY_INLINE void set_depth(int row, const D4& a, const D4& b, const D4& c) { set_linear(row, {-a, -b, base_ - c}); }
  HWY_INLINE void set_band(int index, const D4& slope, const D4& low, const D4& high);
  HWY_INLINE void sphere_axes(const D4 u[3], D4 e1[3], D4 e2[3]) const;
  HWY_INLINE void place_rounds(const Lattice& lattice, const Instance* const part[4], bool tapered, RoundSize& size);
  HWY_INLINE RoundForms round_forms(const RoundSize& size) const;
  HWY_INLINE void require_good_forms(const RoundSize& size, const RoundForms& f);
  HWY_INLINE void finish();

  alignas(32) float values_[kRows][4];
  alignas(32) double reach_[6][4], origin_[3][4], ready_mask_[4];
  bool ready_[4], lens_[4], up_[4];

  D4 m_[3][3], o_[3];    // placement: lattice = m * mesh + o
  D4 l_[3][3], det_;     // adjugate: local = l * (lattice - o) / det
  D4 t_[3];              // l * (origin - o)
  D4 base_, span_, width_x_, ok_, never_;
};

HWY_INLINE void PartBatch::load(const Lattice& lattice, const Instance* const part[4]) {
  alignas(32) double in[12][4];
  for (int lane = 0; lane < 4; ++lane) {
    const Frame& frame = part[lane]->model_from_mesh;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) in[3 * j + i][lane] = double{frame.basis[j][i]};
      in[9 + j][lane] = double{frame.origin[j]};
    }
  }
  for (int i = 0; i < 3; ++i) {
    const D4 scale = number(lattice.scale[i]);
    for (int j = 0; j < 3; ++j) m_[i][j] = D4::load(in[3 * j + i]) * scale;
    o_[i] = (D4::load(in[9 + i]) - number(lattice.origin[i])) * scale - number(lattice.centre[i]);
  }
  for (int j = 0; j < 3; ++j) {
    const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
      l_[j][i] = m_[i1][j1] * m_[i2][j2] - m_[i2][j1] * m_[i1][j2];
    }
  }
  det_ = m_[0][0] * l_[0][0] + m_[1][0] * l_[0][1] + m_[2][0] * l_[0][2];
  never_ = number(0);
  ok_ = less(never_, number(1));
  const D4 volume = det_ * det_ * number(1e12);  // thinner than a millionth of a cell: not ready
  for (int j = 0; j < 3; ++j) {
    ok_ = ok_ & less(l_[j][0] * l_[j][0] + l_[j][1] * l_[j][1] + l_[j][2] * l_[j][2], volume);
  }
}

HWY_INLINE void PartBatch::set_reach(const Lattice& lattice, const D4 centre[3], const D4 extent[3]) {
  D4 from_o[3];
  for (int i = 0; i < 3; ++i) {
    // Also false for NaN.
    ok_ = ok_ & less(extent[i], number(0.5 * kFloatReach - 1)) & less(magnitude(centre[i]), number(1e6));
    const D4 least = number(lattice.low[i]), most = number(lattice.high[i]);
    const D4 low = smaller(larger(rounded_up(centre[i] - extent[i]), least), most);
    const D4 high = smaller(larger(rounded_up(centre[i] + extent[i]), least), most);
    const D4 origin = smaller(larger(rounded_up(centre[i]), least), most);
    low.store(reach_[i]);
    high.store(reach_[3 + i]);
    origin.store(origin_[i]);
    from_o[i] = origin - o_[i];
    if (i == 0) width_x_ = high - low;
    if (i == 2) {
      const D4 deepest = number(32) * rounded_up(high * number(1.0 / 32));  // 32 * (top_word + 1)
      base_ = deepest - origin;
      span_ = high - low;
      store_floats(deepest - high, values_[kTop]);
      store_floats(deepest - low, values_[kBottom]);
    }
  }
  for (int j = 0; j < 3; ++j) t_[j] = l_[j][0] * from_o[0] + l_[j][1] * from_o[1] + l_[j][2] * from_o[2];
}

/// |n . (x, y, z) + offset| <= size / 2. Where that only bounds y, the reach does it already: then a slab that bounds
/// nothing.
HWY_INLINE void PartBatch::set_slab(int index, const D4& nx, const D4& ny, const D4& nz, const D4& offset,
                                    const D4& size) {
  const D4 ax = magnitude(nx), ay = magnitude(ny), az = magnitude(nz);
  const D4 y_only = less(ax * width_x_ + az * span_, number(1e-6) * ay);
  const D4 leaning = less(number(1e-6) * larger(ax, ay), az * span_);
  ok_ = ok_ & (y_only | leaning);
  const D4 z = number(1) / nz, width = magnitude(size * z);
  const D4 zero = number(0), far = number(1e6);
  const int row = kSlab + 4 * index;
  store_floats(choose(y_only, zero, nx * z), values_[row]);
  store_floats(choose(y_only, zero, ny * z), values_[row + 1]);
  store_floats(choose(y_only, far, base_ + offset * z + number(0.5) * width), values_[row + 2]);
  store_floats(choose(y_only, far + far, width), values_[row + 3]);
}

HWY_INLINE void PartBatch::set_band(int index, const D4& slope, const D4& low, const D4& high) {
  const D4 usable = less(magnitude(slope), number(1e3));
  const D4 zero = number(0), far = number(1e6), over = number(7) * slope, margin = number(0.01);
  const int row = kBand + 3 * index;
  store_floats(choose(usable, slope, zero), values_[row]);
  store_floats(choose(usable, low + smaller(over, zero) - margin, -far), values_[row + 1]);
  store_floats(choose(usable, high + larger(over, zero) + margin, far), values_[row + 2]);
}

HWY_INLINE void PartBatch::finish() {
  ok_.store(ready_mask_);
  for (int lane = 0; lane < 4; ++lane) ready_[lane] = ready_mask_[lane] != 0;  // all bits set is a NaN, which is not 0
}

HWY_INLINE void PartBatch::set_boxes(const Lattice& lattice) {
  D4 extent[3];
  for (int i = 0; i < 3; ++i) {
    extent[i] = number(0.5) * (magnitude(m_[i][0]) + magnitude(m_[i][1]) + magnitude(m_[i][2]));
  }
  set_reach(lattice, o_, extent);
  for (int j = 0; j < 3; ++j) set_slab(j, l_[j][0], l_[j][1], l_[j][2], t_[j], det_);
  // Seen along z the box is the sum of three strokes; each pair of parallel sides is a band.
  const D4 dx = o_[0] - D4::load(origin_[0]), dy = o_[1] - D4::load(origin_[1]);
  for (int j = 0; j < 3; ++j) {
    const D4 inverse = number(1) / m_[1][j];
    const D4 slope = m_[0][j] * inverse, middle = dx - slope * dy;
    const D4 half = number(0.5) * (magnitude(l_[(j + 1) % 3][2]) + magnitude(l_[(j + 2) % 3][2])) * magnitude(inverse);
    set_band(j, slope, middle - half, middle + half);
  }
  finish();
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
