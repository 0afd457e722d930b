// Outlines of eight spheres, cylinders and cones, or boxes at once: the same pieces as OutlineMaker's, a part per lane.
// Middles are projected in double precision; what is relative to them needs no more than floats, since parts that are
// large in the image, or come near the nearest plane, are left to OutlineMaker. Included once per target.

#if defined(ESPALIER_SCORE_OUTLINE_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_OUTLINE_BATCH_INL_H
#undef ESPALIER_SCORE_OUTLINE_BATCH_INL_H
#else
#define ESPALIER_SCORE_OUTLINE_BATCH_INL_H
#endif

#include "model/model.h"
#include "score/eight-inl.h"
#include "score/projection.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

enum class BatchKind : std::uint8_t { sphere, round, box };

/// Parts of one kind that wait to be eight.
struct PartQueue {
  const Instance* part[8];
  float top[8];
  int count = 0;
};

/// A point in the image: homogeneous pixels relative to the middle of its part, whose w is 1.
struct H8 {
  F8 x, y, w;
};
HWY_INLINE H8 operator+(const H8& a, const H8& b) { return {a.x + b.x, a.y + b.y, a.w + b.w}; }
HWY_INLINE H8 operator-(const H8& a, const H8& b) { return {a.x - b.x, a.y - b.y, a.w - b.w}; }
HWY_INLINE H8 operator*(const F8& k, const H8& a) { return {k * a.x, k * a.y, k * a.w}; }

class OutlineBatch {
 public:
  static constexpr int kMostEdges = 12;
  static constexpr float kLargest = 192;   // pixels from a part's middle
  static constexpr float kWidestTop = 16;  // a cone's upper radius over its lower

  HWY_INLINE void load(const Projection& projection, const PartQueue& queue);
  HWY_INLINE void set_spheres();
  HWY_INLINE void set_rounds();
  HWY_INLINE void set_boxes();
  /// Rectangles; to be called last.
  HWY_INLINE void finish(const Projection& projection);

  // By lane. Rows of edges_ and ellipses_ are the first members of OutlineEdge and OutlineEllipse; origin_ is 0.
  alignas(32) float edges_[kMostEdges][4][8], ellipses_[2][5][8];
  alignas(32) std::uint32_t kept_[8];   // bit e: edge e is there
  // hexagon_: three faces of a box are seen. Its sides are lines at column slope * y + left or + right; the one that is
  // not meant lies far off.
  alignas(32) float lines_[6][3][8];
  alignas(32) std::uint32_t hexagon_[8];
  alignas(32) std::uint32_t ready_[8];  // all bits: the lane is; none: OutlineMaker must
  alignas(32) std::int32_t origin_[2][8], column_[2][8], row_[2][8];
  int ellipse_count_ = 0;

 private:
  HWY_INLINE void load_middles(const Projection& projection, int half);
  HWY_INLINE void require_near(const Projection& projection);
  HWY_INLINE void include(const F8& x, const F8& y, const F8& reach_x, const F8& reach_y);
  template <int kRadii>
  HWY_INLINE void add_ellipse(const H8& middle, const H8 radius[kRadii]);
  HWY_INLINE void set_hexagons(const H8 corner[3], const F8& mirrored);
  HWY_INLINE void set_box_edges(const F8 turn[3][2]);
  HWY_INLINE void add_edge(int index, const F8& ax, const F8& ay, const F8& bx, const F8& by, const F8& valid);

  alignas(32) float in_[12][8], jacobian_[3][3][8], middle_[2][8], whole_[2][8], depth_[8];
  H8 half_[3];  // half the axes of the mesh's box
  F8 top_, shift_[2], low_[2], high_[2], ok_;
  U8 kept_bits_;
};

// A part's middle, and how pixels change with its points' places: the projection's derivative there.
HWY_INLINE void OutlineBatch::load_middles(const Projection& projection, int half) {
  const auto& m = projection.matrix;
  const int at = 4 * half;
  const D4 o[3] = {load_doubles(in_[9] + at), load_doubles(in_[10] + at), load_doubles(in_[11] + at)};
  D4 point[3];
  for (int r = 0; r < 3; ++r) {
    point[r] = D4::all(m[r][0]) * o[0] + D4::all(m[r][1]) * o[1] + (D4::all(m[r][2]) * o[2] + D4::all(m[r][3]));
  }
  const D4 per_w = D4::all(1) / point[2];
  store_floats(point[2], depth_ + at);
  for (int i = 0; i < 2; ++i) {
    const D4 pixel = point[i] * per_w, whole = rounded_up(pixel);
    store_floats(whole, whole_[i] + at);
    store_floats(pixel - whole, middle_[i] + at);
    for (int k = 0; k < 3; ++k)
      store_floats((D4::all(m[i][k]) - pixel * D4::all(m[2][k])) * per_w, jacobian_[i][k] + at);
  }
  for (int k = 0; k < 3; ++k) store_floats(D4::all(m[2][k]) * per_w, jacobian_[2][k] + at);
}

HWY_INLINE void OutlineBatch::load(const Projection& projection, const PartQueue& queue) {
  for (int lane = 0; lane < 8; ++lane) {
    const Frame& frame = queue.part[lane]->model_from_mesh;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) in_[3 * j + i][lane] = frame.basis[j][i];
      in_[9 + j][lane] = frame.origin[j];
    }
  }
  load_middles(projection, 0);
  load_middles(projection, 1);
  F8 row[3][3];
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) row[r][k] = F8::load(jacobian_[r][k]);
  const F8 half = F8::all(0.5f);
  for (int j = 0; j < 3; ++j) {
    const F8 x = half * F8::load(in_[3 * j]), y = half * F8::load(in_[3 * j + 1]), z = half * F8::load(in_[3 * j + 2]);
    half_[j] = {row[0][0] * x + row[0][1] * y + row[0][2] * z, row[1][0] * x + row[1][1] * y + row[1][2] * z,
                row[2][0] * x + row[2][1] * y + row[2][2] * z};
  }
  top_ = larger(F8::load_anywhere(queue.top), F8::all(0));
  require_near(projection);
  ellipse_count_ = 0;
  kept_bits_ = U8::all(0);
  for (int i = 0; i < 2; ++i) {
    shift_[i] = F8::load(middle_[i]);
    low_[i] = F8::all(1e9f), high_[i] = F8::all(-1e9f);
  }
}

// Lanes with anything that is not finite fail here.
HWY_INLINE void OutlineBatch::require_near(const Projection& projection) {
  const F8 wide = larger(top_, F8::all(1)), depth = F8::load(depth_);
  const F8 across = magnitude(half_[0].x) + magnitude(half_[1].x) + magnitude(half_[2].x) + magnitude(half_[0].y) +
                    magnitude(half_[1].y) + magnitude(half_[2].y);
  const F8 nearest = F8::all(1) - wide * (magnitude(half_[0].w) + magnitude(half_[1].w) + magnitude(half_[2].w));
  const F8 limit = F8::all(static_cast<float>(projection.nearest * 1.0001));
  ok_ = less(wide * across, F8::all(kLargest)) & less(F8::all(0.25f), nearest) & less(limit, nearest * depth) &
        less(top_, F8::all(kWidestTop)) & less(magnitude(F8::load(whole_[0])), F8::all(1e6f)) &
        less(magnitude(F8::load(whole_[1])), F8::all(1e6f));
}

HWY_INLINE void OutlineBatch::include(const F8& x, const F8& y, const F8& reach_x, const F8& reach_y) {
  low_[0] = smaller(low_[0], x - reach_x), high_[0] = larger(high_[0], x + reach_x);
  low_[1] = smaller(low_[1], y - reach_y), high_[1] = larger(high_[1], y + reach_y);
}

// See OutlineMaker::add_ellipse. What is left of the width at right angles to the height comes from the minors of the
// radii, all of them squared, so that nothing cancels where the ellipse is thin.
template <int kRadii>
HWY_INLINE void OutlineBatch::add_ellipse(const H8& middle, const H8 radius[kRadii]) {
  const F8 per_w = F8::all(1) / middle.w, from_x = middle.x * per_w, from_y = middle.y * per_w;
  F8 ww = middle.w * middle.w, xw = F8::all(0), yw = xw, xx = xw, xy = xw, yy = xw, minors = xw, turned = xw;
  F8 x[kRadii], y[kRadii], lean[kRadii];
  for (int i = 0; i < kRadii; ++i) {
    const F8& w = radius[i].w;
    x[i] = radius[i].x - from_x * w, y[i] = radius[i].y - from_y * w;
    ww = ww - w * w, xw = xw - x[i] * w, yw = yw - y[i] * w;
    xx = xx + x[i] * x[i], xy = xy + x[i] * y[i], yy = yy + y[i] * y[i];
    lean[i] = F8::all(0);
  }
  for (int i = 0; i < kRadii; ++i) {
    for (int j = i + 1; j < kRadii; ++j) {
      const F8 minor = x[i] * y[j] - x[j] * y[i];
      minors = minors + minor * minor;
      lean[i] = lean[i] + minor * radius[j].w, lean[j] = lean[j] - minor * radius[i].w;
    }
  }
  for (int i = 0; i < kRadii; ++i) turned = turned + lean[i] * lean[i];
  const F8 per_ww = F8::all(1) / ww, dx = xw * per_ww, dy = yw * per_ww;
  xx = xx * per_ww + dx * dx, xy = xy * per_ww + dx * dy, yy = yy * per_ww + dy * dy;
  const F8 half_height = square_root(yy), reach = square_root(xx), flat = less(yy, F8::all(1e-18f));
  const F8 per_height = F8::all(1) / choose(flat, F8::all(1), half_height);
  const F8 half_width = square_root(minors + turned * per_ww) * per_ww * per_height;
  const F8 at_x = from_x + dx + shift_[0], at_y = from_y + dy + shift_[1];
  float(*to)[8] = ellipses_[ellipse_count_++];
  at_x.store(to[0]), at_y.store(to[1]), (xy * per_height).store(to[2]);
  half_width.store(to[3]);
  choose(flat, F8::all(1e9f), per_height).store(to[4]);  // along a row: no pixel's middle lies in it
  include(at_x, at_y, reach, half_height);
}

HWY_INLINE void OutlineBatch::add_edge(int index, const F8& ax, const F8& ay, const F8& bx, const F8& by,
                                       const F8& valid) {
  const F8 down = less(ay, by), y_low = smaller(ay, by), y_high = larger(ay, by), tall = y_high - y_low;
  const F8 x = choose(down, ax, bx), there = less(F8::all(1e-9f), tall) & valid;
  const F8 zero = F8::all(0), slope = (choose(down, bx, ax) - x) / choose(there, tall, F8::all(1));
  float(*to)[8] = edges_[index];
  choose(there, y_low, F8::all(1e9f)).store(to[0]);  // else: in no row
  choose(there, y_high, F8::all(-1e9f)).store(to[1]);
  choose(there, x, zero).store(to[2]), choose(there, slope, zero).store(to[3]);
  kept_bits_ = kept_bits_ | (bits_of(there) & U8::all(1u << index));
}

HWY_INLINE void OutlineBatch::set_spheres() {
  const F8 zero = F8::all(0);
  add_ellipse<3>({zero, zero, F8::all(1)}, half_);
}

// See OutlineMaker::add_tangents: with the middle at (0, 0, 1) most of the determinants' terms vanish.
HWY_INLINE void OutlineBatch::set_rounds() {
  const H8 middle{F8::all(0), F8::all(0), F8::all(1)}, u = half_[0], v = half_[2], h = half_[1];
  const H8 lower = middle - h, upper = middle + h, rim[2] = {u, v}, upper_rim[2] = {top_ * u, top_ * v};
  add_ellipse<2>(lower, rim);
  add_ellipse<2>(upper, upper_rim);
  const F8 two = F8::all(2), one = F8::all(1), nw = v.x * u.y - v.y * u.x;  // of v x u
  const F8 a = two * (h.x * v.y - h.y * v.x), b = two * (h.y * u.x - h.x * u.y);
  const F8 lean = h.x * (v.y * u.w - v.w * u.y) + h.y * (v.w * u.x - v.x * u.w) + h.w * nw;
  const F8 c = (one - top_) * nw + (one + top_) * lean;
  const F8 square = a * a + b * b, rest = square - c * c, seen = less(F8::all(1e-30f), rest);
  const F8 root = square_root(larger(rest, F8::all(0))), per_square = one / choose(seen, square, one);
  for (int i = 0; i < 2; ++i) {
    const F8 by = i == 0 ? root : -root;
    const F8 cosine = (-(a * c) - b * by) * per_square, sine = (a * by - b * c) * per_square;
    const H8 point = cosine * u + sine * v, from = lower + point, to = upper + top_ * point;
    const F8 per_from = one / from.w, per_to = one / to.w;
    add_edge(i, from.x * per_from + shift_[0], from.y * per_from + shift_[1], to.x * per_to + shift_[0],
             to.y * per_to + shift_[1], seen);
  }
}

HWY_INLINE void OutlineBatch::set_boxes() {
  const H8 &p = half_[0], &q = half_[1], &r = half_[2];
  const F8 area[3] = {q.x * r.y - q.y * r.x, r.x * p.y - r.y * p.x, p.x * q.y - p.y * q.x};
  const F8 volume = r.w * area[2] + r.x * (p.y * q.w - p.w * q.y) + r.y * (p.w * q.x - p.x * q.w);
  // Which faces at the low and high ends of the axes turn clockwise in the image; of a hexagon one at each.
  F8 turn[3][2], all_three = ok_, odd = F8::all(0);
  H8 corner[3];
  for (int j = 0; j < 3; ++j) {
    turn[j][0] = less(area[j], volume), turn[j][1] = less(-area[j], volume);
    all_three = all_three & (turn[j][0] ^ turn[j][1]);
    odd = odd ^ turn[j][0];
    const H8& h = half_[j];
    corner[j] = {choose(turn[j][1], h.x, -h.x), choose(turn[j][1], h.y, -h.y), choose(turn[j][1], h.w, -h.w)};
  }
  set_hexagons(corner, odd);
  bits_of(all_three).store(hexagon_);
  if (any_but(bits_of(all_three))) set_box_edges(turn);
}

// The corners that are next to one of the two that are seen and hidden: h0 + h1 + h2 and its opposite.
HWY_INLINE void OutlineBatch::set_hexagons(const H8 h[3], const F8& mirrored) {
  static constexpr int kAround[6][3] = {{1, 1, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}};
  F8 x[6], y[6];
  const F8 zero = F8::all(0), one = F8::all(1), far = F8::all(1e9f);
  for (int i = 0; i < 6; ++i) {
    H8 p{zero, zero, one};
    for (int j = 0; j < 3; ++j) p = kAround[i][j] != 0 ? p + h[j] : p - h[j];
    const F8 per_w = one / p.w;
    x[i] = p.x * per_w + shift_[0], y[i] = p.y * per_w + shift_[1];
    include(x[i], y[i], zero, zero);
  }
  for (int i = 0; i < 6; ++i) {
    const F8 wide = x[(i + 1) % 6] - x[i], tall = y[(i + 1) % 6] - y[i];
    const F8 there = less(F8::all(1e-6f) * magnitude(wide), magnitude(tall));  // else along a row: does not bound it
    const F8 slope = choose(there, wide / choose(there, tall, one), zero), at = x[i] - slope * y[i];
    const F8 left = less(zero, tall) ^ mirrored;
    slope.store(lines_[i][0]);
    choose(there & left, at, -far).store(lines_[i][1]);
    choose(there, choose(left, far, at), far).store(lines_[i][2]);
  }
}

// Boxes of which fewer faces are seen, or that are flat: the edges between a face that turns one way and one that turns
// the other.
HWY_INLINE void OutlineBatch::set_box_edges(const F8 turn[3][2]) {
  F8 x[8], y[8];
  const F8 zero = F8::all(0);
  for (int i = 0; i < 8; ++i) {
    H8 p{zero, zero, F8::all(1)};
    for (int j = 0; j < 3; ++j) p = i >> j & 1 ? p + half_[j] : p - half_[j];
    const F8 per_w = F8::all(1) / p.w;
    x[i] = p.x * per_w + shift_[0], y[i] = p.y * per_w + shift_[1];
    include(x[i], y[i], zero, zero);
  }
  for (int e = 0; e < 12; ++e) {  // along axis j, at the low or high ends of the next two
    const int j = e / 4, k = (j + 1) % 3, l = (j + 2) % 3, at_k = e & 1, at_l = e >> 1 & 1;
    const int from = at_k << k | at_l << l, to = from | 1 << j;
    add_edge(e, x[from], y[from], x[to], y[to], turn[k][at_k] ^ turn[l][at_l]);
  }
}

HWY_INLINE void OutlineBatch::finish(const Projection& projection) {
  const F8 half = F8::all(0.5f);
  const std::uint32_t size[2] = {projection.width, projection.height};
  for (int i = 0; i < 2; ++i) {
    const I8 origin = truncate(F8::load(whole_[i])), zero = I8::all(0), most = I8::all(static_cast<int>(size[i]));
    origin.store(origin_[i]);
    std::int32_t(*range)[8] = i == 0 ? column_ : row_;
    smaller(larger(truncate(rounded_up(low_[i] - half)) + origin, zero), most).store(range[0]);
    smaller(larger(truncate(rounded_up(high_[i] - half)) + origin, zero), most).store(range[1]);
  }
  kept_bits_.store(kept_);
  bits_of(ok_).store(ready_);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
