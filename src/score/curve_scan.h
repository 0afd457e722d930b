#pragma once
// CurveScan: the nearest points of several cubic Bézier curves, eight samples of a curve at a time. Internal to
// CurveFinder.

#include <cstddef>

namespace espalier {

/// One curve, made ready. Sample i is the point at t = i / (kSamples - 1).
struct alignas(32) CurveTable {
  static constexpr std::size_t kSamples = 32;

  float sample[3][kSamples];  // by axis, m
  float power[4][4] = {};     // coefficients of t^0 .. t^3; the fourth of each is 0
  double derivative[3][3];    // of the derivative, t^0 .. t^2
  double slope[6];            // of curve . derivative, t^0 .. t^5
  float reach = 0;            // no point of the curve is further from the sample nearest in t, m
};

struct CurveHit {
  float t;          // 0..1
  float distance2;  // m2; infinity: another curve is nearer
};

/// hits[i] = the point of curve i that is nearest to p, or nothing (infinity) where another curve is nearer for sure.
/// The same bits on every CPU.
void scan_curves(const CurveTable* curves, std::size_t count, const float p[3], CurveHit* hits);
/// The parameter of the point of one curve that is nearest to p; the very bits of its hit.
float scan_curve(const CurveTable& curve, const float p[3]);

}  // namespace espalier
