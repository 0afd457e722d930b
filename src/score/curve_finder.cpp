#include "score/curve_finder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/check.h"

namespace espalier {
namespace {

float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float length(const Vec3& v) { return std::sqrt(dot(v, v)); }
double length(const DVec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

Vec3 point(const std::array<Vec3, 4>& c, float t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

/// How far the curve is from the chord of [from, to] at most, m. Between points of equal parameter the distance is at
/// most the greatest second derivative times the eighth of the step's square; that derivative is linear.
double greatest_gap(const CubicBezier& curve, double from, double to) {
  const double bend = std::max(length(second_derivative_at(curve, from)), length(second_derivative_at(curve, to)));
  return bend * (to - from) * (to - from) / 8;
}

}  // namespace

CurveFinder::CurveFinder(const std::vector<CubicBezier>& curves, bool blend) : blend_(blend && curves.size() > 1) {
  CHECK(!curves.empty());
  for (const CubicBezier& curve : curves) curves_.push_back(prepare(curve));
}

CurveFinder::Prepared CurveFinder::prepare(const CubicBezier& curve) {
  Prepared out;
  const DVec3 p0(curve.points[0]), p1(curve.points[1]), p2(curve.points[2]), p3(curve.points[3]);
  out.power = {Vec3(p0), Vec3(3.0 * (p1 - p0)), Vec3(3.0 * (p0 - 2.0 * p1 + p2)), Vec3(p3 - 3.0 * p2 + 3.0 * p1 - p0)};
  double gap = 0, largest = 0;
  Bounds box;
  for (const Vec3& corner : curve.points) {
    box.add(corner);
    largest = std::max(largest, length(DVec3(corner)));
  }
  for (std::size_t i = 0; i < kChords; ++i) {
    const double t0 = static_cast<double>(i) / kChords, t1 = static_cast<double>(i + 1) / kChords;
    const DVec3 a = point_at(curve, t0), along = point_at(curve, t1) - a;
    const double length2 = along.x * along.x + along.y * along.y + along.z * along.z;
    for (int axis = 0; axis < 3; ++axis) {
      out.from[axis][i / 4][i % 4] = static_cast<float>(a[axis]);
      out.along[axis][i / 4][i % 4] = static_cast<float>(along[axis]);
    }
    out.per_length2[i / 4][i % 4] = length2 > 1e-30 ? static_cast<float>(1 / length2) : 0.0f;
    gap = std::max(gap, greatest_gap(curve, t0, t1));
  }
  out.centre = box.centre();
  for (const Vec3& corner : curve.points) out.radius = std::max(out.radius, length(corner - out.centre));
  // What floats may lose is put on top.
  out.gap = static_cast<float>(gap + 1e-6 * largest);
  out.radius += static_cast<float>(1e-6 * largest);
  out.still = 1e-5f * std::max({length(out.power[1]), length(out.power[2]), length(out.power[3])});
  return out;
}

/// No point of the curve is nearer, m.
float CurveFinder::bound(const Prepared& curve, const Vec3& p) { return length(p - curve.centre) - curve.radius; }

CurveFinder::Hit CurveFinder::refine(const Prepared& curve, const Vec3& p, float t) {
  const std::array<Vec3, 4>& c = curve.power;
  Vec3 away = point(c, t) - p;
  Hit best{t, dot(away, away)};
  for (int turn = 0; turn < 8; ++turn) {  // half as many leave errors of 0.01 here and there
    const Vec3 first = c[1] + t * (2.0f * c[2] + t * (3.0f * c[3]));
    const Vec3 second = 2.0f * c[2] + t * (6.0f * c[3]);
    const float slope = dot(away, first), speed2 = dot(first, first);
    const float bend = speed2 + dot(away, second);
    // Where the distance is no valley, a step of Gauss and Newton still leads down.
    float step = bend > 0.1f * speed2 ? slope / bend : slope / speed2;
    if (!(speed2 > 0)) step = 0;
    const float next = std::clamp(t - step, 0.0f, 1.0f);
    if (next == t) break;
    t = next;
    away = point(c, t) - p;
    const float distance2 = dot(away, away);
    // Of what is equally far but for rounding, the later one: distances tell t to no better than the root of that.
    if (distance2 < 1.000001f * best.distance2) best = {t, distance2};
    if (std::abs(step) < 1e-5f) break;
  }
  return best;
}

CurveFinder::Hit CurveFinder::closest(const Prepared& curve, const Vec3& p) {
  std::array<Row, kRows> near2, at;
  Row least = Row{} + std::numeric_limits<float>::infinity();
  for (std::size_t row = 0; row < kRows; ++row) {
    const Row x = p.x - curve.from[0][row], y = p.y - curve.from[1][row], z = p.z - curve.from[2][row];
    const Row dx = curve.along[0][row], dy = curve.along[1][row], dz = curve.along[2][row];
    Row s = (x * dx + y * dy + z * dz) * curve.per_length2[row];
    s = s > 0 ? s : Row{};
    s = s < 1 ? s : Row{} + 1;
    const Row ex = x - s * dx, ey = y - s * dy, ez = z - s * dz;
    near2[row] = ex * ex + ey * ey + ez * ez;
    at[row] = s;
    least = near2[row] < least ? near2[row] : least;
  }
  const float smallest = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
  const float reach = std::sqrt(smallest) + 2 * curve.gap;
  const float reach2 = std::max(reach * reach, smallest);  // far away a small gap is lost in rounding
  // One start in each valley that may hold the nearest point.
  float distance2[kChords];
  std::memcpy(distance2, near2.data(), sizeof distance2);
  Hit best{0, std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < kChords; ++i) {
    const float here = distance2[i];
    if (here > reach2) continue;
    if ((i > 0 && distance2[i - 1] <= here) || (i + 1 < kChords && distance2[i + 1] < here)) continue;
    const Hit hit = refine(curve, p, (static_cast<float>(i) + at[i / 4][i % 4]) * (1.0f / kChords));
    if (hit.distance2 < best.distance2) best = hit;
  }
  return best;
}

Vec3 CurveFinder::tangent(const Prepared& curve, float t) {
  const std::array<Vec3, 4>& c = curve.power;
  Vec3 way = c[1] + t * (2.0f * c[2] + t * (3.0f * c[3]));
  float size = length(way);
  if (!(size > curve.still)) {
    // It stands still here, but for rounding: where it comes from, and where it goes.
    constexpr float kAside = 1.0f / 64;
    way = point(c, std::min(t + kAside, 1.0f)) - point(c, std::max(t - kAside, 0.0f));
    size = length(way);
  }
  return size > 1e-12f ? (1.0f / size) * way : Vec3(0);
}

float CurveFinder::parameter_on(std::uint32_t curve, const Vec3& p) const { return closest(curves_[curve], p).t; }

CurvePoint CurveFinder::nearest(const Vec3& p) const {
  CurvePoint found;
  float least2 = std::numeric_limits<float>::infinity(), least = least2;
  for (std::uint32_t i = 0; i < curves_.size(); ++i) {
    if (bound(curves_[i], p) > least) continue;
    const Hit hit = closest(curves_[i], p);
    if (!(hit.distance2 < least2)) continue;
    least2 = hit.distance2;
    least = std::sqrt(least2);
    found.curve = i;
    found.t = hit.t;
  }
  found.distance = least;
  found.tangent = tangent(curves_[found.curve], found.t);
  if (blend_) found.tangent = blended_tangent(found, p);
  return found;
}

/// Each of the two nearest curves counts by how near it is beside the other: alike where they are equally near.
Vec3 CurveFinder::blended_tangent(const CurvePoint& nearest, const Vec3& p) const {
  float least = std::numeric_limits<float>::infinity();
  std::uint32_t second = nearest.curve;
  float t = 0;
  for (std::uint32_t i = 0; i < curves_.size(); ++i) {
    if (i == nearest.curve || bound(curves_[i], p) > least) continue;
    const Hit hit = closest(curves_[i], p);
    const float distance = std::sqrt(hit.distance2);
    if (!(distance < least)) continue;
    least = distance, second = i, t = hit.t;
  }
  const Vec3 sum = least * nearest.tangent + nearest.distance * tangent(curves_[second], t);
  const float size = length(sum);
  return size > 1e-12f ? (1.0f / size) * sum : nearest.tangent;
}

}  // namespace espalier
