#include "score/curve_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"

namespace espalier {
namespace {

float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float length(const Vec3& v) { return std::sqrt(dot(v, v)); }
double length(const DVec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

Vec3 coefficient(const CurveTable& curve, int k) { return {curve.power[k][0], curve.power[k][1], curve.power[k][2]}; }

Vec3 point(const CurveTable& curve, float t) {
  return coefficient(curve, 0) +
         t * (coefficient(curve, 1) + t * (coefficient(curve, 2) + t * coefficient(curve, 3)));
}

/// How far the curve is from the chord of [from, to] at most, m. Between points of equal parameter the distance is at
/// most the greatest second derivative times the eighth of the step's square; that derivative is linear.
double greatest_gap(const CubicBezier& curve, double from, double to) {
  const double bend = std::max(length(second_derivative_at(curve, from)), length(second_derivative_at(curve, to)));
  return bend * (to - from) * (to - from) / 8;
}

}  // namespace

CurveFinder::CurveFinder(const std::vector<CubicBezier>& curves, bool blend) : blend_(blend && curves.size() > 1) {
  CHECK(!curves.empty() && curves.size() <= kMostCurves);
  for (const CubicBezier& curve : curves) prepare(curve);
}

void CurveFinder::prepare(const CubicBezier& curve) {
  CurveTable& out = curves_.emplace_back();
  const DVec3 p0(curve.points[0]), p1(curve.points[1]), p2(curve.points[2]), p3(curve.points[3]);
  const DVec3 power[] = {p0, 3.0 * (p1 - p0), 3.0 * (p0 - 2.0 * p1 + p2), p3 - 3.0 * p2 + 3.0 * p1 - p0};
  double largest = 0;
  for (const Vec3& corner : curve.points) largest = std::max(largest, length(DVec3(corner)));
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 4; ++k) out.power[k][axis] = static_cast<float>(power[k][axis]);
  }
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) out.derivative[k][axis] = (k + 1) * power[k + 1][axis];
  for (double& coefficient : out.slope) coefficient = 0;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      for (int axis = 0; axis < 3; ++axis) out.slope[k + j] += power[k][axis] * out.derivative[j][axis];
  // A sample stands for the curve half-way to its neighbours.
  constexpr double kStep = 1.0 / (CurveTable::kSamples - 1);
  double reach = 0;
  for (std::size_t i = 0; i < CurveTable::kSamples; ++i) {
    const double t = static_cast<double>(i) * kStep;
    const DVec3 here = point_at(curve, t);
    for (int axis = 0; axis < 3; ++axis) out.sample[axis][i] = static_cast<float>(here[axis]);
    for (const double end : {std::max(t - kStep / 2, 0.0), std::min(t + kStep / 2, 1.0)}) {
      reach = std::max(reach, length(point_at(curve, end) - here) + greatest_gap(curve, t, end));
    }
  }
  out.reach = static_cast<float>(reach + 1e-6 * largest);  // what floats may lose is put on top
  still_.push_back(static_cast<float>(1e-5 * std::max({length(power[1]), length(power[2]), length(power[3])})));
}

Vec3 CurveFinder::tangent(std::size_t index, float t) const {
  const CurveTable& curve = curves_[index];
  Vec3 way = coefficient(curve, 1) + t * (2.0f * coefficient(curve, 2) + t * (3.0f * coefficient(curve, 3)));
  float size = length(way);
  if (!(size > still_[index])) {
    // It stands still here, but for rounding: where it comes from, and where it goes.
    constexpr float kAside = 1.0f / 64;
    way = point(curve, std::min(t + kAside, 1.0f)) - point(curve, std::max(t - kAside, 0.0f));
    size = length(way);
  }
  return size > 1e-12f ? (1.0f / size) * way : Vec3(0);
}

float CurveFinder::parameter_on(std::uint32_t curve, const Vec3& p) const {
  return scan_curve(curves_[curve], &p.x);
}

CurvePoint CurveFinder::nearest(const Vec3& p) const {
  CurveHit hits[kMostCurves];
  scan_curves(curves_.data(), curves_.size(), &p.x, hits);
  CurvePoint found;
  for (std::uint32_t i = 1; i < curves_.size(); ++i) {
    if (hits[i].distance2 < hits[found.curve].distance2) found.curve = i;
  }
  found.t = hits[found.curve].t;
  found.distance = std::sqrt(hits[found.curve].distance2);
  found.tangent = tangent(found.curve, found.t);
  if (blend_) found.tangent = blended_tangent(found, p);
  return found;
}

/// Each of the two nearest curves counts by how near it is beside the other: alike where they are equally near.
Vec3 CurveFinder::blended_tangent(const CurvePoint& nearest, const Vec3& p) const {
  CurveHit second{0, std::numeric_limits<float>::infinity()};
  std::size_t curve = nearest.curve;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    if (i == nearest.curve) continue;
    CurveHit hit;
    scan_curves(&curves_[i], 1, &p.x, &hit);
    if (hit.distance2 < second.distance2) second = hit, curve = i;
  }
  const Vec3 sum = std::sqrt(second.distance2) * nearest.tangent + nearest.distance * tangent(curve, second.t);
  const float size = length(sum);
  return size > 1e-12f ? (1.0f / size) * sum : nearest.tangent;
}

}  // namespace espalier
