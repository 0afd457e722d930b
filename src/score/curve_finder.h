#pragma once
// CurveFinder: the nearest of several cubic Bézier curves, and the nearest point on it (Guiding curves 2018, equations
// 1, 2 and 5), exactly: chords bound how far each piece of a curve can be, Newton's method finds the point on those
// that may be nearest. Floats throughout; the same bits on every CPU.

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "score/bezier.h"

namespace espalier {

struct CurvePoint {
  std::uint32_t curve = 0;
  float t = 0;         // 0..1
  float distance = 0;  // m
  Vec3 tangent{0};     // unit; zero where a curve is no more than a point
};

class CurveFinder {
 public:
  /// At least one; finite. `blend`: tangents are those of the two nearest curves, blended by distance.
  CurveFinder(const std::vector<CubicBezier>& curves, bool blend);

  std::size_t size() const { return curves_.size(); }
  /// The nearest curve; of curves as near, the first.
  CurvePoint nearest(const Vec3& p) const;
  /// The parameter of the point of one curve that is nearest to p, 0..1.
  float parameter_on(std::uint32_t curve, const Vec3& p) const;

 private:
  static constexpr std::size_t kChords = 16;
  using Row = float __attribute__((vector_size(16)));
  static constexpr std::size_t kRows = kChords / 4;

  /// Chord i runs from t = i / kChords over 1 / kChords.
  struct Prepared {
    std::array<Row, kRows> from[3], along[3], per_length2;
    std::array<Vec3, 4> power;  // coefficients of t^0 .. t^3
    float gap = 0;              // no point is further from its chord, m
    float still = 0;            // a derivative no longer than that is rounding
    Vec3 centre{0};             // a ball around the curve
    float radius = 0;
  };
  struct Hit {
    float t = 0, distance2 = 0;
  };

  static Prepared prepare(const CubicBezier& curve);
  static float bound(const Prepared& curve, const Vec3& p);
  static Hit closest(const Prepared& curve, const Vec3& p);
  static Hit refine(const Prepared& curve, const Vec3& p, float t);
  static Vec3 tangent(const Prepared& curve, float t);
  Vec3 blended_tangent(const CurvePoint& nearest, const Vec3& p) const;

  std::vector<Prepared> curves_;
  bool blend_;
};

}  // namespace espalier
