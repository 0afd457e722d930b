#include "score/convex_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier {
namespace {

constexpr double kThinnest = 1e-6;  // cells; thinner things are flat
constexpr double kInfinite = std::numeric_limits<double>::infinity();

void clip(double low_by, double high_by, double& low, double& high) {
  low = std::max(low, low_by);
  high = std::min(high, high_by);
}

/// n . (x, y, z) <= d along z.
void clip_half_space(double nz, double rest, double& low, double& high) {
  if (nz > 0) {
    high = std::min(high, rest / nz);
  } else if (nz < 0) {
    low = std::max(low, rest / nz);
  } else if (!(rest > 0)) {
    high = -kInfinite;
  }
}

}  // namespace

bool aligned_box(const Lattice& lattice, const GridPlacement& placement, Reach& reach, bool& covers) {
  double half[3];
  int along[3];
  for (int i = 0; i < 3; ++i) {
    const double v[3] = {std::abs(placement.m[i][0]), std::abs(placement.m[i][1]), std::abs(placement.m[i][2])};
    along[i] = v[1] > v[0] ? 1 : 0;
    if (v[2] > v[along[i]]) along[i] = 2;
    half[i] = 0.5 * v[along[i]];
    if (v[0] + v[1] + v[2] - v[along[i]] > 2e-5) return false;
  }
  if (along[0] == along[1] || along[0] == along[2] || along[1] == along[2]) return false;
  covers = half[0] > 0.5 * kThinnest && half[1] > 0.5 * kThinnest && half[2] > 0.5 * kThinnest;
  reach = reach_of(lattice, placement.o, half);
  return true;
}

bool ConvexShape::invert(const GridPlacement& placement, const Solid& solid) {
  const auto& m = placement.m;
  double det = 0;
  for (int j = 0; j < 3; ++j) {
    const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
      l[j][i] = m[i1][j1] * m[i2][j2] - m[i2][j1] * m[i1][j2];
    }
  }
  for (int i = 0; i < 3; ++i) det += m[i][0] * l[0][i];
  for (int j = 0; j < 3; ++j) {  // distance between the faces of the mesh's box, squared
    const double area2 = l[j][0] * l[j][0] + l[j][1] * l[j][1] + l[j][2] * l[j][2];
    const double depth = 2 * solid.half[j] * det;
    if (!(depth * depth > kThinnest * kThinnest * area2)) return false;
  }
  const double scale = 1 / det;
  if (!(std::abs(scale) < kInfinite)) return false;
  for (auto& row : l) {
    for (double& v : row) v *= scale;
  }
  return true;
}

void ConvexShape::set_extent(const Solid& solid, const GridPlacement& placement, double top) {
  double centre[3];
  for (int i = 0; i < 3; ++i) {
    const double* m = placement.m[i];
    centre[i] = placement.o[i];
    const double across = std::sqrt(m[0] * m[0] + m[2] * m[2]);
    if (kind == SolidKind::sphere) {
      extent[i] = 0.5 * std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    } else if (kind == SolidKind::round) {  // hull of two discs
      const double up = 0.5 * m[1];
      const double high = std::max(top * 0.5 * across + up, 0.5 * across - up);
      const double low = std::min(-top * 0.5 * across + up, -0.5 * across - up);
      centre[i] += 0.5 * (high + low);
      extent[i] = 0.5 * (high - low);
    } else {
      // A prism that widens upwards reaches `top` times as far from its axis, which need not be the box's middle.
      const double wide = kind == SolidKind::prism ? std::max(1.0, top) : 1.0;
      extent[i] = 0;
      for (int j = 0; j < 3; ++j) {
        const double scale = j == 1 ? 1.0 : wide;
        centre[i] += m[j] * solid.centre[j] * scale;
        extent[i] += std::abs(m[j]) * solid.half[j] * scale;
      }
    }
  }
  for (int i = 0; i < 3; ++i) t[i] = centre[i];  // handed to set_origin
}

void ConvexShape::set_origin(const Lattice& lattice, const double centre[3]) {
  for (int i = 0; i < 3; ++i) origin[i] = ceil_clamped(centre[i], lattice.low[i], lattice.high[i]);
}

void ConvexShape::set_planes(const Solid& solid, double top) {
  for (const Plane& plane : solid.planes) {
    Plane p = plane;
    if (kind == SolidKind::prism) {  // n . (x, z) <= offset * (1 + (top - 1) * (y + 1/2))
      p.normal[1] = -plane.offset * (top - 1);
      p.offset = plane.offset * (1 + 0.5 * (top - 1));
    }
    Plane q{{0, 0, 0}, p.offset};
    for (int j = 0; j < 3; ++j) {
      q.offset -= p.normal[j] * t[j];
      for (int i = 0; i < 3; ++i) q.normal[i] += p.normal[j] * l[j][i];
    }
    planes.push_back(q);
  }
}

bool ConvexShape::set(const Lattice& lattice, const Solid& solid, const GridPlacement& placement, float instance_top) {
  kind = solid.kind;
  planes.clear();
  double top = 1;
  if (solid.tapered) {
    top = instance_top > 0 ? double{instance_top} : 0.0;
    if (!(top < kFarthest) || instance_top != instance_top) return false;
  }
  set_extent(solid, placement, top);
  reach = reach_of(lattice, t, extent);
  if (reach.empty()) return false;
  set_origin(lattice, t);
  if (!invert(placement, solid)) return false;
  for (int j = 0; j < 3; ++j) {
    t[j] = 0;
    for (int i = 0; i < 3; ++i) t[j] += l[j][i] * (origin[i] - placement.o[i]);
  }
  slabs = kind == SolidKind::box ? 3 : kind == SolidKind::round || kind == SolidKind::prism ? 1 : 0;
  slab_row[0] = kind == SolidKind::box ? 0 : 1;
  slab_row[1] = kind == SolidKind::box ? 1 : 0;
  if (kind == SolidKind::round) {
    taper = 0.5 * (top - 1);
    radius = 0.25 * (1 + top);
  }
  if (kind == SolidKind::convex || kind == SolidKind::prism) set_planes(solid, top);
  return true;
}

void ConvexShape::clip_to_sphere(double x, double y, double& low, double& high) const {
  double a = 0, b = 0, c = -0.25;
  for (int j = 0; j < 3; ++j) {
    const double p = l[j][0] * x + l[j][1] * y + t[j];
    a += l[j][2] * l[j][2];
    b += l[j][2] * p;
    c += p * p;
  }
  const double d = b * b - a * c;
  if (d < 0) {
    high = -kInfinite;
    return;
  }
  const double root = std::sqrt(d);
  clip((-b - root) / a, (-b + root) / a, low, high);
}

// F(z) = X^2 + Z^2 - R^2 = a z^2 + 2 b z + c with X, Z, R linear in z; see docs/volume.md, "Cones".
void ConvexShape::clip_to_round(double x, double y, double& low, double& high) const {
  const double px = l[0][0] * x + l[0][1] * y + t[0], xz = l[0][2];
  const double pz = l[2][0] * x + l[2][1] * y + t[2], zz = l[2][2];
  const double pr = radius + taper * (l[1][0] * x + l[1][1] * y + t[1]), rz = taper * l[1][2];
  const double a = xz * xz + zz * zz - rz * rz;
  const double b = xz * px + zz * pz - rz * pr;
  const double c = px * px + pz * pz - pr * pr;
  // d = b^2 - a c, grouped so that near-axis rows do not cancel.
  const double gu = pr * xz - rz * px, gv = pr * zz - rz * pz, v = xz * pz - zz * px;
  const double d = gu * gu + gv * gv - v * v;
  if (d < 0) {
    if (a >= 0) high = -kInfinite;
    return;  // a < 0: only rounding near the apex; the slab bounds the row
  }
  const double q = b < 0 ? -b + std::sqrt(d) : -b - std::sqrt(d);
  if (q == 0) {  // b = d = 0: touches at z = 0, or flat along z
    if (a > 0 || c > 0) high = -kInfinite;
    return;
  }
  const double far = a != 0 ? q / a : (q > 0 ? kInfinite : -kInfinite);  // a -> 0 sends one root away
  const double near = c / q;
  if (a > 0) {
    clip(std::min(far, near), std::max(far, near), low, high);
  } else if (a < 0) {  // the row runs along the opening: on the nappe with a positive radius
    if (rz > 0) low = std::max(low, std::max(far, near));
    else high = std::min(high, std::min(far, near));
  } else if (b > 0) {
    high = std::min(high, near);
  } else {
    low = std::max(low, near);
  }
}

void ConvexShape::column(double x, double y, double& low, double& high) const {
  low = -kInfinite;
  high = kInfinite;
  for (int s = 0; s < slabs; ++s) {
    const int j = slab_row[s];
    const double p = l[j][0] * x + l[j][1] * y + t[j];
    clip_half_space(l[j][2], 0.5 - p, low, high);
    clip_half_space(-l[j][2], 0.5 + p, low, high);
  }
  for (const Plane& plane : planes) {
    clip_half_space(plane.normal[2], plane.offset - plane.normal[0] * x - plane.normal[1] * y, low, high);
  }
  if (kind == SolidKind::sphere) clip_to_sphere(x, y, low, high);
  if (kind == SolidKind::round) clip_to_round(x, y, low, high);
}

bool ConvexShape::fills_reach() const {
  for (int corner = 0; corner < 4; ++corner) {
    const double x = (corner & 1 ? reach.high[0] - 1 : reach.low[0]) - origin[0];
    const double y = (corner & 2 ? reach.high[1] - 1 : reach.low[1]) - origin[1];
    double low, high;
    column(x, y, low, high);
    if (!(low <= reach.low[2] - origin[2] && high > reach.high[2] - 1 - origin[2])) return false;
  }
  return true;
}

}  // namespace espalier
