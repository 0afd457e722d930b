#pragma once
// CurveScan: the nearest points of several cubic Bézier curves, eight chords of a curve at a time. Internal to
// CurveFinder.

#include <cstddef>

namespace espalier {

/// One curve, made ready. Chord i runs from t = i / kChords over 1 / kChords.
struct alignas(32) CurveTable {
  static constexpr std::size_t kChords = 16;

  float from[3][kChords], along[3][kChords];  // by axis, m
  float per_length2[kChords];                 // 1 / squared length; 0 where a chord is a point
  float power[4][3];                          // coefficients of t^0 .. t^3
  float gap = 0;                              // no point of the curve is further from its chord, m
};

struct CurveHit {
  float t = 0;          // 0..1
  float distance2 = 0;  // m2; infinity: another curve is nearer
};

/// hits[i] = the point of curve i that is nearest to p, or nothing (infinity) where another curve is nearer for sure.
/// The same bits on every CPU.
void scan_curves(const CurveTable* curves, std::size_t count, const float p[3], CurveHit* hits);

}  // namespace espalier
