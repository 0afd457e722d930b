#pragma once
// CubicBezier: one cubic Bézier segment in space, and how long it is.

#include <array>

#include "base/vec.h"

namespace espalier {

struct CubicBezier {
  std::array<Vec3, 4> points{};  // m

  bool operator==(const CubicBezier&) const = default;
};

DVec3 point_at(const CubicBezier& curve, double t);
/// By t; zero where the curve stands still.
DVec3 derivative_at(const CubicBezier& curve, double t);
DVec3 second_derivative_at(const CubicBezier& curve, double t);

/// Of the piece from t = 0 to t in 0..1, m; relative error below 1e-9 where the curve has no cusp.
double length_to(const CubicBezier& curve, double t);

}  // namespace espalier
