#pragma once
// CurveFinder: the nearest of several cubic Bézier curves, and the nearest point on it (Guiding curves 2018, equations
// 1, 2 and 5), exactly: chords bound how far each piece of a curve can be, Newton's method finds the point on those
// that may be nearest. Floats throughout; the same bits on every CPU.

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "score/bezier.h"
#include "score/curve_scan.h"

namespace espalier {

struct CurvePoint {
  std::uint32_t curve = 0;
  float t = 0;         // 0..1
  float distance = 0;  // m
  Vec3 tangent{0};     // unit; zero where a curve is no more than a point
};

class CurveFinder {
 public:
  static constexpr std::size_t kMostCurves = 64;

  /// 1 to kMostCurves; finite. `blend`: tangents are those of the two nearest curves, blended by distance.
  CurveFinder(const std::vector<CubicBezier>& curves, bool blend);

  std::size_t size() const { return curves_.size(); }
  /// The nearest curve; of curves as near, the first.
  CurvePoint nearest(const Vec3& p) const;
  /// The parameter of the point of one curve that is nearest to p, 0..1.
  float parameter_on(std::uint32_t curve, const Vec3& p) const;

 private:
  void prepare(const CubicBezier& curve);
  Vec3 tangent(std::size_t curve, float t) const;
  Vec3 blended_tangent(const CurvePoint& nearest, const Vec3& p) const;

  std::vector<CurveTable> curves_;
  std::vector<float> still_;  // per curve: a derivative no longer than that is rounding
  bool blend_;
};

}  // namespace espalier
