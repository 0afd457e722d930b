#pragma once
// ReferenceCurves: what a skeleton costs under guiding curves, straight from the equations of the paper (Guiding curves
// 2018, section 3.3). Slow and plain on purpose: double precision, points by dense sampling and golden section, lengths
// by fine summation, no code shared with the kernels. For tests.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "model/model.h"
#include "score/guiding_curve.h"

namespace espalier {

struct ReferencePoint {
  std::size_t curve = 0;
  double t = 0;         // 0..1
  double distance = 0;  // m
  DVec3 tangent{0};     // unit; zero where a curve is no more than a point
  /// Of the next valley of the distance, on this curve or another one, m; infinity if there is none. Near a tie floats
  /// may decide otherwise.
  double rival = 0;
};

/// The terms of one skeleton.
struct ReferenceCosts {
  double distance = 0, alignment = 0, utilisation = 0, density = 0;
  double total() const { return distance + alignment + utilisation + density; }
};

class ReferenceCurves {
 public:
  /// Settings must be valid; whether they ask for a field makes no difference.
  explicit ReferenceCurves(const CurveSettings& settings);

  /// Equations 1, 2 and 5: the nearest curve and the point on it; the tangent blended if the settings say so.
  ReferencePoint nearest(const DVec3& p) const;
  /// The point of one curve that is nearest to p.
  ReferencePoint closest(std::size_t curve, const DVec3& p) const;
  DVec3 point(std::size_t curve, double t) const;
  /// Where the curve stands still: where it goes from there, or at its end where it comes from.
  DVec3 tangent(std::size_t curve, double t) const;

  /// From t = 0, m; relative error below 1e-6.
  double length_to(std::size_t curve, double t) const;
  double length(std::size_t curve) const { return lengths_[curve].back(); }
  /// How many segments of equal length a curve has.
  std::size_t segments(std::size_t curve) const;
  /// How many segments lie behind t; its integer part is the segment of t. 0..segments.
  double segments_to(std::size_t curve, double t) const;

  /// Equation 6 for a bone with its base there, or an expected direction (equation 10). Zero directions cost nothing.
  double alignment(const ReferencePoint& base, const DVec3& direction) const;
  /// Equation 3, for what lies beyond the curve's thickness.
  double distance_cost(const ReferencePoint& base) const;
  /// Equation 8, and what is too dense.
  ReferenceCosts costs(std::span<const Bone> bones) const;

 private:
  static constexpr std::size_t kSamples = 2048;  // pieces of a curve

  double distance_at(std::size_t curve, double t, const DVec3& p) const;
  double golden_section(std::size_t curve, const DVec3& p, double low, double high) const;
  double density_cost(std::span<const Bone> bones) const;

  CurveSettings settings_;
  std::vector<std::vector<DVec3>> samples_;    // per curve, at t = i / kSamples
  std::vector<std::vector<double>> lengths_;   // likewise: of what lies behind, m
};

}  // namespace espalier
