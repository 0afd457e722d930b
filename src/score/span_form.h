#pragma once
// SpanForm: a convex shape as the SIMD kernel draws it, in floats. Rows run along z and are measured from above: a row's
// depth f = base - z counts from the top of the highest 32-voxel word that the part reaches, so that f is never negative
// and ceil(z) becomes truncation. A row covers the depths between f_high (its upper end, smaller f) and f_low.

#include <cstdint>

#include "score/convex_shape.h"

namespace espalier {

/// a * x + b * y + c, with x and y relative to the shape's origin.
struct LinearForm {
  float a = 0, b = 0, c = 0;
};

enum class Quadric : std::uint8_t {
  none,
  sphere,  // f = middle +- sqrt(rest(y) - across^2), rest = most - (side.b * y + side.c)^2
  lens,    // f = middle +- sqrt(along^2 - across^2)
  up,      // a row within a cone's opening, solid above: f_low = middle - sqrt(along^2 + across^2)
  down,    // solid below: f_high = middle + sqrt(along^2 + across^2)
};

struct SpanForm {
  static constexpr int kMostLimits = 8;

  std::int32_t origin[3];
  Reach reach;
  std::int32_t top_word;  // floor((reach.high[2] - 1) / 32); depths count down from z = 32 * (top_word + 1)
  float f_top, f_bottom;  // depths of the reach's two ends: f_top <= f <= f_bottom

  int slabs;              // f_low = min over slabs, f_high = max(slab - width)
  LinearForm slab[3];
  float width[3];
  int lowers, uppers;     // f_low = min over plane[0, lowers), f_high = max over the rest
  LinearForm plane[Solid::kMostPlanes + 2];

  Quadric quadric;
  LinearForm middle, along, across, side;
  float most;

  // What stands upright bounds x instead, row by row, in double precision: n_x * x + n_y * y <= offset.
  int limits;
  double limit[kMostLimits][3];
  bool upright;  // a cylinder along z: its ellipse as limits
  double ellipse[5];

  /// False if floats are not good enough, or there are too many limits: then draw by ConvexShape::column.
  bool set(const ConvexShape& shape);

  bool limited() const { return limits > 0 || upright; }
  /// For the rows y .. y + 7 (relative to origin): covered x lie in (low, high), half-integers relative to origin.
  void row_limits(std::int32_t y, float low[8], float high[8]) const;

 private:
  bool add_half_space(const double normal[3], double offset);
  bool set_slabs(const ConvexShape& shape);
  bool set_round(const ConvexShape& shape);
  void set_sphere(const ConvexShape& shape);
  bool set_upright(const ConvexShape& shape);
  LinearForm depth(double a, double b, double c) const;
};

/// Parts that reach over more cells than this lose too much in floats.
inline constexpr std::int32_t kFloatReach = 768;

}  // namespace espalier
