#include "score/polygon.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

/// Where the edge from p to q, one above and one below, meets the plane.
DVec3 crossing(const DVec3& p, const DVec3& q, int axis, double at) {
  const double share = (at - p[axis]) / (q[axis] - p[axis]);
  DVec3 point;
  for (int i = 0; i < 3; ++i) {
    // Rounding must not carry it beyond the ends: polygons stay within the layers of their corners.
    point[i] = std::clamp(p[i] + share * (q[i] - p[i]), std::min(p[i], q[i]), std::max(p[i], q[i]));
  }
  point[axis] = at;
  return point;
}

}  // namespace

double Polygon::fan_area(std::size_t i) const {
  return 0.5 * glm::length(glm::cross(corners_[i] - corners_[0], corners_[i + 1] - corners_[0]));
}

double Polygon::area() const {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < count_; ++i) sum += fan_area(i);
  return sum;
}

DVec3 Polygon::point(double at, double r, double s) const {
  std::size_t i = 1;
  for (; i + 2 < count_; ++i) {
    const double here = fan_area(i);
    if (at < here) break;
    at -= here;
  }
  // Turk, Generating random points in triangles, Graphics Gems 1990.
  const double t = std::sqrt(r);
  return corners_[0] + t * ((1 - s) * (corners_[i] - corners_[0]) + s * (corners_[i + 1] - corners_[0]));
}

void cut(const Polygon& polygon, int axis, double at, Polygon& below, Polygon& above) {
  below.clear();
  above.clear();
  bool lower = false;  // some of it lies below
  for (std::size_t i = 0; i < polygon.count(); ++i) {
    const DVec3 &p = polygon[i], &q = polygon[i + 1 < polygon.count() ? i + 1 : 0];
    lower |= p[axis] < at;
    if (p[axis] <= at) below.add(p);
    if (p[axis] >= at) above.add(p);
    if ((p[axis] < at && q[axis] > at) || (p[axis] > at && q[axis] < at)) {
      const DVec3 point = crossing(p, q, axis, at);
      below.add(point);
      above.add(point);
    }
  }
  if (!lower) below.clear();
}

}  // namespace espalier
