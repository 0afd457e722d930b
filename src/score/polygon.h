#pragma once
// Polygon: a flat convex polygon in space, as triangles become where voxels cut them; and how to draw points on it.

#include <array>
#include <cstddef>

#include "base/vec.h"

namespace espalier {

class Polygon {
 public:
  Polygon() = default;
  Polygon(const DVec3& a, const DVec3& b, const DVec3& c) : corners_{a, b, c}, count_(3) {}

  std::size_t count() const { return count_; }
  const DVec3& operator[](std::size_t i) const { return corners_[i]; }
  /// Square metres; 0 below three corners.
  double area() const;
  /// A point drawn evenly from the area by three numbers: `at`, from 0 to area(), tells the triangle of the fan around
  /// the first corner, `r` and `s`, in [0, 1), the place in it.
  DVec3 point(double at, double r, double s) const;

  void clear() { count_ = 0; }
  void add(const DVec3& corner) {
    if (count_ < kMostCorners) corners_[count_++] = corner;
  }

 private:
  double fan_area(std::size_t i) const;

  // Six planes make at most nine corners of a triangle. Rounding can make more of a sliver; what is left out then has
  // no area to speak of.
  static constexpr std::size_t kMostCorners = 16;
  std::array<DVec3, kMostCorners> corners_;
  std::size_t count_ = 0;
};

/// Cuts along the plane where the coordinate of `axis` is `at` (Sutherland and Hodgman 1974). A polygon that lies in
/// the plane goes above, so that no area is counted twice or lost.
void cut(const Polygon& polygon, int axis, double at, Polygon& below, Polygon& above);

}  // namespace espalier
