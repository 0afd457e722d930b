#include "score/bezier.h"

#include <cmath>

namespace espalier {
namespace {

DVec3 wide_point(const CubicBezier& curve, std::size_t i) { return DVec3(curve.points[i]); }

double speed(const CubicBezier& curve, double t) {
  const DVec3 d = derivative_at(curve, t);
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

/// Gauss-Legendre with five points.
double piece(const CubicBezier& curve, double from, double to) {
  constexpr double kAt[] = {0, 0.5384693101056830910, 0.9061798459386639928};
  constexpr double kWeight[] = {0.5688888888888888889, 0.4786286704993664680, 0.2369268850561890875};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = kWeight[0] * speed(curve, middle);
  for (int i = 1; i < 3; ++i) {
    sum += kWeight[i] * (speed(curve, middle - half * kAt[i]) + speed(curve, middle + half * kAt[i]));
  }
  return half * sum;
}

}  // namespace

DVec3 point_at(const CubicBezier& curve, double t) {
  const double s = 1 - t;
  return s * s * s * wide_point(curve, 0) + 3 * s * s * t * wide_point(curve, 1) +
         3 * s * t * t * wide_point(curve, 2) + t * t * t * wide_point(curve, 3);
}

DVec3 derivative_at(const CubicBezier& curve, double t) {
  const double s = 1 - t;
  const DVec3 a = wide_point(curve, 1) - wide_point(curve, 0), b = wide_point(curve, 2) - wide_point(curve, 1),
              c = wide_point(curve, 3) - wide_point(curve, 2);
  return 3.0 * (s * s * a + 2 * s * t * b + t * t * c);
}

DVec3 second_derivative_at(const CubicBezier& curve, double t) {
  const DVec3 a = wide_point(curve, 2) - 2.0 * wide_point(curve, 1) + wide_point(curve, 0),
              b = wide_point(curve, 3) - 2.0 * wide_point(curve, 2) + wide_point(curve, 1);
  return 6.0 * ((1 - t) * a + t * b);
}

double length_to(const CubicBezier& curve, double t) {
  constexpr int kPieces = 32;
  double length = 0;
  for (int i = 0; i < kPieces; ++i) length += piece(curve, t * i / kPieces, t * (i + 1) / kPieces);
  return length;
}

}  // namespace espalier
