#include "score/outline.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

constexpr double kNever = 1e300;
constexpr double kHugest = 8192;  // pixels: beyond, single precision would lose a thousandth of one

DVec3 wide(const Vec3& v) { return {v.x, v.y, v.z}; }
double det(const DVec3& a, const DVec3& b, const DVec3& c) { return glm::dot(a, glm::cross(b, c)); }

/// Corners of the unit box; two are joined by an edge where their numbers differ in one bit.
const std::vector<Vec3> kBoxCorners = [] {
  std::vector<Vec3> list;
  for (int i = 0; i < 8; ++i) list.emplace_back(i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f);
  return list;
}();

/// Of homogeneous coordinates.
template <class Pixel>
Pixel divided(const DVec3& p) {
  const double per_w = 1 / p.z;
  return {p.x * per_w, p.y * per_w};
}

/// The pixels whose middles lie in [low, high), within 0..size; nothing is left where low > high or either is NaN.
void set_range(double low, double high, std::uint32_t size, std::int32_t range[2]) {
  const double most = size;
  range[0] = static_cast<std::int32_t>(std::ceil(std::clamp(low - 0.5, -1.0, most)));
  range[1] = static_cast<std::int32_t>(std::ceil(std::clamp(high - 0.5, -1.0, most)));
  range[0] = std::max(range[0], 0);
  if (!(low <= high)) range[1] = range[0];
}

}  // namespace

void OutlineMaker::place(const Instance& instance, double top) {
  const Frame& m = instance.model_from_mesh;
  centre_ = projection_.point(wide(m.origin));
  for (int i = 0; i < 3; ++i) axis_[i] = projection_.vector(wide(m.basis[i]));
  top_ = top;
  ellipses_.clear();
  outline_.ellipses.clear();
  begin();
}

void OutlineMaker::begin() {
  segments_.clear();
  cuts_.clear();
  outline_.edges.clear();
  low_ = {kNever, kNever};
  high_ = {-kNever, -kNever};
}

void OutlineMaker::include(const Pixel& p) {
  low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
  high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
}

void OutlineMaker::place_corners(const std::vector<Vec3>& corners) {
  corners_.resize(corners.size());
  double least = kNever;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& c = corners[i];
    const double k = c.y > 0 ? top_ : 1;
    corners_[i] = centre_ + axis_[0] * (k * c.x) + axis_[1] * double{c.y} + axis_[2] * (k * c.z);
    least = std::min(least, corners_[i].z);
  }
  whole_ = least >= projection_.nearest;
  if (!whole_) return;
  pixels_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) pixels_[i] = divided<Pixel>(corners_[i]);
}

OutlineMaker::Result OutlineMaker::set(const Caster& caster, const Instance& instance) {
  caster_ = &caster;
  if (caster.kind == Caster::Kind::nothing) return Result::nothing;
  place(instance, caster.tapered ? std::max(instance.top, 0.0f) : 1.0);
  if (caster.kind == Caster::Kind::sphere) return set_sphere();
  if (caster.kind == Caster::Kind::round) return set_round(top_);
  place_corners(caster.corners);
  if (caster.kind == Caster::Kind::triangles) return Result::triangles;
  if (whole_) {
    for (const Pixel& pixel : pixels_) include(pixel);
    if (!open_rectangle()) return Result::nothing;
    for (const auto& [a, b] : caster.edges) add_edge(pixels_[a], pixels_[b]);
    return Result::outline;
  }
  for (const auto& [a, b] : caster.edges) add_segment(corners_[a], corners_[b], &cuts_);
  // Where the nearest plane cuts a polyhedron, the cut is convex too: its border is among the lines between its
  // corners.
  for (std::size_t i = 0; i < cuts_.size(); ++i)
    for (std::size_t j = i + 1; j < cuts_.size(); ++j) add_segment(cuts_[i], cuts_[j], nullptr);
  return finish() ? Result::outline : Result::nothing;
}

bool OutlineMaker::triangle(std::size_t i) {
  const Triangle& t = caster_->triangles[i];
  begin();
  if (whole_) {
    for (const std::uint32_t corner : t) include(pixels_[corner]);
    if (!open_rectangle()) return false;
    for (int k = 0; k < 3; ++k) add_edge(pixels_[t[k]], pixels_[t[(k + 1) % 3]]);
    return true;
  }
  for (int k = 0; k < 3; ++k) add_segment(corners_[t[k]], corners_[t[(k + 1) % 3]], &cuts_);
  if (cuts_.size() == 2) add_segment(cuts_[0], cuts_[1], nullptr);
  return finish();
}

// The part of a line that lies beyond the nearest plane; `cuts`: takes the point where it crosses.
void OutlineMaker::add_segment(const DVec3& a_in, const DVec3& b_in, std::vector<DVec3>* cuts) {
  DVec3 a = a_in, b = b_in;
  const double nearest = cuts ? projection_.nearest : 0;
  if (!(a.z >= nearest) && !(b.z >= nearest)) return;
  if (!(a.z >= nearest && b.z >= nearest)) {
    if (a.z < b.z) std::swap(a, b);
    b = a + (b - a) * ((a.z - nearest) / (a.z - b.z));
    b.z = nearest;
    cuts->push_back(b);
  }
  segments_.push_back({divided<Pixel>(a), divided<Pixel>(b)});
  include(segments_.back().a);
  include(segments_.back().b);
}

// The outline of a ball (a circle or a sphere) is an ellipse, whose dual conic is m m' - sum r r' (Hartley and
// Zisserman, Multiple View Geometry, 8.3). Coordinates are taken from near its middle, so nothing cancels.
bool OutlineMaker::add_ellipse(const Ball& ball) {
  const Pixel from = divided<Pixel>(ball.middle);
  double ww = ball.middle.z * ball.middle.z, xw = 0, yw = 0, xx = 0, xy = 0, yy = 0;
  for (const DVec3& r : ball.radius) {
    const double x = r.x - from.x * r.z, y = r.y - from.y * r.z;
    ww -= r.z * r.z, xw -= x * r.z, yw -= y * r.z;
    xx += x * x, xy += x * y, yy += y * y;
  }
  const double per_ww = 1 / ww, x = xw * per_ww, y = yw * per_ww;
  xx = xx * per_ww + x * x, xy = xy * per_ww + x * y, yy = yy * per_ww + y * y;
  if (!(yy > 1e-18)) return std::isfinite(yy);  // flat along a row: no pixel's middle lies in it
  Ellipse e;
  e.middle = {from.x + x, from.y + y};
  e.half_height = std::sqrt(yy);
  e.per_half_height = 1 / e.half_height;
  e.lean = xy * e.per_half_height;
  e.half_width = std::sqrt(std::max(0.0, xx - e.lean * e.lean));
  ellipses_.push_back(e);
  const double reach = std::sqrt(xx);
  include({e.middle.x - reach, e.middle.y - e.half_height});
  include({e.middle.x + reach, e.middle.y + e.half_height});
  return e.half_height < kHugest && reach < kHugest && std::isfinite(e.lean);
}

OutlineMaker::Result OutlineMaker::set_sphere() {
  const Ball ball{centre_, {0.5 * axis_[0], 0.5 * axis_[1], 0.5 * axis_[2]}};
  const double reach = 0.5 * std::sqrt(axis_[0].z * axis_[0].z + axis_[1].z * axis_[1].z + axis_[2].z * axis_[2].z);
  if (!(centre_.z + reach >= projection_.nearest)) return Result::nothing;
  if (!(centre_.z - reach >= projection_.nearest) || !add_ellipse(ball)) return by_pixel();
  return finish() ? Result::outline : Result::nothing;
}

OutlineMaker::Result OutlineMaker::set_round(double top) {
  const DVec3 u = 0.5 * axis_[0], v = 0.5 * axis_[2], lower = centre_ - 0.5 * axis_[1],
              upper = centre_ + 0.5 * axis_[1];
  const double reach = std::sqrt(u.z * u.z + v.z * v.z), nearest = projection_.nearest;
  if (!(lower.z + reach >= nearest) && !(upper.z + top * reach >= nearest)) return Result::nothing;
  if (!(lower.z - reach >= nearest && upper.z - top * reach >= nearest)) return by_pixel();
  bool usable = add_ellipse({lower, {u, v, DVec3(0)}});
  if (top > 0) usable &= add_ellipse({upper, {top * u, top * v, DVec3(0)}});
  if (!usable) return by_pixel();
  add_tangents(lower, upper, top);
  return finish() ? Result::outline : Result::nothing;
}

// Generators of the side that are seen edge-on. With points on the rims B(t) = lower + u cos t + v sin t and T(t) of
// the upper rim, det(B, T, B') = 0, which is linear in cos t and sin t since T - ratio B does not depend on t.
void OutlineMaker::add_tangents(const DVec3& lower, const DVec3& upper, double ratio) {
  const DVec3 u = 0.5 * axis_[0], v = 0.5 * axis_[2], e = upper - ratio * lower;
  const double a = det(lower, e, v), b = -det(lower, e, u), c = det(u, e, v);
  const double square = a * a + b * b, rest = square - c * c;
  if (!(rest > 0)) return;  // one rim hides the other
  const double wide_root = std::sqrt(rest), per_square = 1 / square;
  for (const double root : {wide_root, -wide_root}) {
    const double cosine = (-a * c - b * root) * per_square, sine = (-b * c + a * root) * per_square;
    const DVec3 rim = cosine * u + sine * v;
    add_segment(lower + rim, upper + ratio * rim, nullptr);
  }
}

// The rectangle of the part's box.
OutlineMaker::Result OutlineMaker::by_pixel() {
  const double top = top_;
  top_ = std::max(top, 1.0);
  begin();
  place_corners(kBoxCorners);
  top_ = top;
  for (std::uint32_t i = 0; i < 8; ++i)
    for (const std::uint32_t bit : {1u, 2u, 4u})
      if (!(i & bit)) add_segment(corners_[i], corners_[i | bit], &cuts_);
  segments_.clear();
  ellipses_.clear();
  return finish() ? Result::by_pixel : Result::nothing;
}

// The rectangle of all that was included; pieces are relative to its middle. False if no pixel's middle lies in it.
bool OutlineMaker::open_rectangle() {
  set_range(low_.x, high_.x, projection_.width, outline_.column);
  set_range(low_.y, high_.y, projection_.height, outline_.row);
  if (outline_.column[0] >= outline_.column[1] || outline_.row[0] >= outline_.row[1]) return false;
  outline_.origin[0] = (outline_.column[0] + outline_.column[1]) / 2;
  outline_.origin[1] = (outline_.row[0] + outline_.row[1]) / 2;
  const double width = projection_.width, height = projection_.height;
  near_ = low_.x >= -width && high_.x <= 2 * width && low_.y >= -height && high_.y <= 2 * height;
  return true;
}

bool OutlineMaker::finish() {
  if (!open_rectangle()) return false;
  for (const Segment& segment : segments_) add_edge(segment.a, segment.b);
  for (const Ellipse& e : ellipses_) {
    outline_.ellipses.push_back({static_cast<float>(e.middle.x - outline_.origin[0]),
                                 static_cast<float>(e.middle.y - outline_.origin[1]), static_cast<float>(e.lean),
                                 static_cast<float>(e.half_width), static_cast<float>(e.per_half_height),
                                  static_cast<float>(e.middle.y - e.half_height - outline_.origin[1]),
                                  static_cast<float>(e.middle.y + e.half_height - outline_.origin[1])});
  }
  return true;
}

// Far beyond the image an edge may stand anywhere: its columns there are clamped, so floats stay small where it counts.
void OutlineMaker::add_edge(Pixel a, Pixel b) {
  if (a.y > b.y) std::swap(a, b);
  if (near_) return push_edge(a, b);
  const double width = projection_.width, height = projection_.height;
  const double left = -width, right = 2 * width, above = -height, below = 2 * height;
  if (!(b.y >= above && a.y <= below)) return;
  const auto at_row = [&](double y) {
    return Pixel{a.y == b.y ? a.x : a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)), y};
  };
  const Pixel from = a.y < above ? at_row(above) : a, to = b.y > below ? at_row(below) : b;
  // Rows where it crosses the left and the right end, between which it is cut.
  std::array<Pixel, 4> stops = {from, from, to, to};
  int inner = 1;
  for (const double end : {left, right}) {
    if ((from.x < end) == (to.x < end)) continue;
    stops[inner++] = {end, from.y + (to.y - from.y) * ((end - from.x) / (to.x - from.x))};
  }
  if (inner == 3 && stops[1].y > stops[2].y) std::swap(stops[1], stops[2]);
  for (int i = 0; i < 3; ++i) {
    const auto clamped = [&](const Pixel& p) { return Pixel{std::clamp(p.x, left, right), p.y}; };
    push_edge(clamped(stops[i]), clamped(stops[i + 1]));
  }
}

void OutlineMaker::push_edge(const Pixel& a, const Pixel& b) {
  const double tall = b.y - a.y;
  if (!(tall > 1e-9)) return;  // along a row: its ends are ends of other edges too
  const double ax = a.x - outline_.origin[0], bx = b.x - outline_.origin[0];
  outline_.edges.push_back({static_cast<float>(a.y - outline_.origin[1]), static_cast<float>(b.y - outline_.origin[1]),
                            static_cast<float>(ax), static_cast<float>((bx - ax) / tall)});
}

}  // namespace espalier
