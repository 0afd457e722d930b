#pragma once
// SpanForm: a convex shape as the SIMD kernel draws it, in floats. Rows run along z and are measured from above: the
// depth f = base - z counts from the top of the highest 32-voxel word that the part reaches, so that f is never
// negative and ceil(z) becomes truncation. A row covers the depths between f_high (its upper end, smaller f) and f_low.

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

/// Covered x lie in [slope * y + low, slope * y + high] for the eight rows from y on: spares the kernel most of the
/// empty corners of a part's box. Relative to the shape's origin.
struct Band {
  float slope, low, high;
};

class SpanForm {
 public:
  static constexpr int kMostLimits = 8;

  /// False if floats are not good enough, or there are too many limits: then draw by ConvexShape::column.
  bool set(const ConvexShape& shape);

  const Reach& reach() const { return reach_; }
  std::int32_t origin(int axis) const { return origin_[axis]; }
  Quadric quadric() const { return quadric_; }
  /// Depths of the reach's two ends: f_top <= f <= f_bottom.
  float f_top() const { return f_top_; }
  float f_bottom() const { return f_bottom_; }

  /// f_low = min over slabs, f_high = max(slab - width). Slab 0 exists always; it may bound nothing.
  int slabs() const { return slabs_; }
  const LinearForm& slab(int i) const { return slab_[i]; }
  float width(int i) const { return width_[i]; }
  /// f_low = min over plane [0, lowers), f_high = max over the rest.
  int lowers() const { return lowers_; }
  int uppers() const { return uppers_; }
  const LinearForm& plane(int i) const { return plane_[i]; }

  const LinearForm& middle() const { return middle_; }
  const LinearForm& along() const { return along_; }
  const LinearForm& across() const { return across_; }
  const LinearForm& side() const { return side_; }
  float most() const { return most_; }

  static constexpr int kBands = 0;
  Band band(int) const { return {0, 0, 0}; }

  /// What stands upright bounds x instead, row by row, in double precision.
  bool limited() const { return limits_ > 0 || upright_; }
  /// For the rows y .. y + 7 (relative to origin): covered x lie in (low, high), half-integers relative to origin.
  void row_limits(std::int32_t y, float low[8], float high[8]) const;

 private:
  bool add_half_space(const double normal[3], double offset);
  bool set_slabs(const ConvexShape& shape);
  bool set_round(const ConvexShape& shape);
  void set_sphere(const ConvexShape& shape);
  bool set_upright(const ConvexShape& shape);
  bool well_conditioned(const ConvexShape& shape, double a, const double middle[3], const double along[3]) const;
  LinearForm depth(double a, double b, double c) const;

  std::int32_t origin_[3];
  Reach reach_;
  std::int32_t top_word_;  // floor((reach.high[2] - 1) / 32); depths count down from z = 32 * (top_word + 1)
  float f_top_, f_bottom_;
  int slabs_, lowers_, uppers_, limits_;
  LinearForm slab_[3];
  float width_[3];
  LinearForm plane_[Solid::kMostPlanes + 2];
  Quadric quadric_;
  LinearForm middle_, along_, across_, side_;
  float most_;
  double limit_[kMostLimits][3];  // n_x, n_y, offset: n . (x, y) <= offset
  bool upright_;                  // a cylinder along z: its ellipse as limits
  double ellipse_[5];
};

/// Estimated error of a cone's row end, in units of float rounding; beyond it doubles take over.
inline constexpr double kWorstCondition = 1000;

/// Parts that reach over more cells than this lose too much in floats.
inline constexpr std::int32_t kFloatReach = 768;

}  // namespace espalier
