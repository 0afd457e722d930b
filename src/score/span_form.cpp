#include "score/span_form.h"

#include <algorithm>
#include <cmath>

namespace espalier {
namespace {

/// A face that leans by less than this many cells over the height of its part counts as upright.
constexpr double kUpright = 1e-6;

LinearForm scaled(double a, double b, double c, double s) {
  return {static_cast<float>(a * s), static_cast<float>(b * s), static_cast<float>(c * s)};
}

double height(const Reach& reach) { return reach.high[2] - reach.low[2]; }

/// A face that only bounds y: the reach does that already, exactly.
bool bounds_y_only(double nx, double ny, double nz, double span_x, double span_z) {
  return std::abs(nx) * span_x + std::abs(nz) * span_z <= kUpright * std::abs(ny);
}

bool is_upright(double nx, double ny, double nz, double span) {
  return std::abs(nz) * span <= kUpright * std::max(std::abs(nx), std::abs(ny));
}

std::int32_t floor_div(std::int32_t a, std::int32_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

/// The depth of the plane z = a x + b y + c.
LinearForm SpanForm::depth(double a, double b, double c) const {
  const double base = 32.0 * (top_word_ + 1) - origin_[2];
  return {static_cast<float>(-a), static_cast<float>(-b), static_cast<float>(base - c)};
}

bool SpanForm::add_half_space(const double n[3], double offset) {
  if (is_upright(n[0], n[1], n[2], height(reach_))) {
    if (limits_ == kMostLimits) return false;
    limit_[limits_][0] = n[0];
    limit_[limits_][1] = n[1];
    limit_[limits_][2] = offset;
    ++limits_;
    return true;
  }
  const LinearForm form = depth(-n[0] / n[2], -n[1] / n[2], offset / n[2]);
  if (n[2] < 0) {  // lowers come first
    plane_[lowers_ + uppers_] = plane_[lowers_];
    plane_[lowers_++] = form;
  } else {
    plane_[lowers_ + uppers_++] = form;
  }
  return true;
}

bool SpanForm::set_slabs(const ConvexShape& shape) {
  const double span = height(reach_), width_x = reach_.high[0] - reach_.low[0];
  for (int s = 0; s < shape.slabs; ++s) {
    const int j = shape.slab_row[s];
    const double* n = shape.l[j];
    if (bounds_y_only(n[0], n[1], n[2], width_x, span)) continue;
    if (is_upright(n[0], n[1], n[2], span)) {
      const double back[3] = {-n[0], -n[1], -n[2]};
      if (!add_half_space(n, 0.5 - shape.t[j]) || !add_half_space(back, 0.5 + shape.t[j])) return false;
      continue;
    }
    const double z = 1 / n[2], half = 0.5 * std::abs(z);
    slab_[slabs_] = depth(-n[0] * z, -n[1] * z, -shape.t[j] * z - half);
    width_[slabs_++] = static_cast<float>(2 * half);
  }
  if (slabs_ == 0) {  // bounds nothing
    slab_[slabs_] = {0, 0, f_bottom_};
    width_[slabs_++] = f_bottom_ - f_top_;
  }
  return true;
}

// |local|^2 = 1/4 along z: with u the unit vector of z in local space, the part of a point across u splits into one
// component that x moves and one (`side`) that only y moves.
void SpanForm::set_sphere(const ConvexShape& shape) {
  const auto& l = shape.l;
  const double a = l[0][2] * l[0][2] + l[1][2] * l[1][2] + l[2][2] * l[2][2];
  const double s = 1 / std::sqrt(a);
  const double u[3] = {l[0][2] * s, l[1][2] * s, l[2][2] * s};
  double e2[3] = {u[1] * l[2][0] - u[2] * l[1][0], u[2] * l[0][0] - u[0] * l[2][0], u[0] * l[1][0] - u[1] * l[0][0]};
  const double e = 1 / std::sqrt(e2[0] * e2[0] + e2[1] * e2[1] + e2[2] * e2[2]);
  for (double& v : e2) v *= e;
  const double e1[3] = {e2[1] * u[2] - e2[2] * u[1], e2[2] * u[0] - e2[0] * u[2], e2[0] * u[1] - e2[1] * u[0]};
  double mid[3] = {0, 0, 0}, one[3] = {0, 0, 0}, two[3] = {0, 0, 0};
  for (int j = 0; j < 3; ++j) {
    const double p[3] = {l[j][0], l[j][1], shape.t[j]};
    for (int k = 0; k < 3; ++k) {
      mid[k] -= u[j] * p[k] * s;
      one[k] += e1[j] * p[k] * s;
      two[k] += e2[j] * p[k] * s;
    }
  }
  quadric_ = Quadric::sphere;
  middle_ = depth(mid[0], mid[1], mid[2]);
  across_ = scaled(one[0], one[1], one[2], 1);
  side_ = scaled(0, two[1], two[2], 1);
  most_ = static_cast<float>(0.25 * s * s);
}

bool SpanForm::set_upright(const ConvexShape& shape) {
  // X^2 + Z^2 <= r^2 with X, Z linear in x, y: (p x + k y + c)^2 + (m y + d)^2 <= r^2.
  const double ax = shape.l[0][0], ay = shape.l[0][1], bx = shape.l[2][0], by = shape.l[2][1];
  const double p = std::sqrt(ax * ax + bx * bx);
  if (!(p > 0)) return false;
  upright_ = true;
  ellipse_[0] = (ax * ay + bx * by) / (p * p);
  ellipse_[1] = (ax * shape.t[0] + bx * shape.t[2]) / (p * p);
  ellipse_[2] = (ax * by - bx * ay) / (p * p);
  ellipse_[3] = (ax * shape.t[2] - bx * shape.t[0]) / (p * p);
  ellipse_[4] = shape.radius * shape.radius / (p * p);
  return true;
}

/// Rows nearly along a cone's side: one end is the difference of two large numbers. Its error in z, times how steeply
/// the surface is cut there, is the error in cells.
bool SpanForm::well_conditioned(const ConvexShape& shape, double a, const double middle[3],
                                const double along[3]) const {
  const auto& l = shape.l;
  const double ex = shape.extent[0], ey = shape.extent[1];
  const double m = std::abs(middle[0]) * ex + std::abs(middle[1]) * ey + std::abs(middle[2]) + height(reach_);
  const double h = std::abs(along[0]) * ex + std::abs(along[1]) * ey + std::abs(along[2]);
  const double widest = shape.radius + 0.5 * std::abs(shape.taper);
  const double per_cell_x = l[0][0] * l[0][0] + l[0][1] * l[0][1] + l[0][2] * l[0][2];
  const double per_cell_z = l[2][0] * l[2][0] + l[2][1] * l[2][1] + l[2][2] * l[2][2];
  const double per_cell = std::sqrt(std::min(per_cell_x, per_cell_z));  // change of the local radius
  return m * h * std::abs(a) < kWorstCondition * widest * per_cell;
}

// With <u, w> = uX wX + uZ wZ - uR wR, a row's ends solve <q, q> = 0, q = p + z d, p the row's start, d its direction:
// z = (-<d,p> +- sqrt(D)) / <d,d> and D = along^2 -+ across^2 with `across` the distance from the axis' plane.
bool SpanForm::set_round(const ConvexShape& shape) {
  const auto& l = shape.l;
  const double span = height(reach_);
  const double rz = shape.taper * l[1][2];
  const double g = std::sqrt(l[0][2] * l[0][2] + l[2][2] * l[2][2]);
  if (g * span < 1e-8 && shape.taper == 0) return set_upright(shape);
  const double a = (g - std::abs(rz)) * (g + std::abs(rz));
  const double dx = g > 0 ? l[0][2] / g : 1, dz = g > 0 ? l[2][2] / g : 0;
  if (a == 0) return false;
  double mid[3], p[3], v[3];
  for (int k = 0; k < 3; ++k) {
    const double x = k < 2 ? l[0][k] : shape.t[0], y = k < 2 ? l[1][k] : shape.t[1], z = k < 2 ? l[2][k] : shape.t[2];
    const double r = shape.taper * y + (k < 2 ? 0 : shape.radius);
    const double u = x * dx + z * dz;
    mid[k] = -(g * u - rz * r) / a;
    p[k] = (g * r - rz * u) / std::abs(a);
    v[k] = (z * dx - x * dz) / std::sqrt(std::abs(a));
  }
  if (shape.taper != 0 && !well_conditioned(shape, a, mid, p)) return false;
  quadric_ = a > 0 ? Quadric::lens : rz > 0 ? Quadric::up : Quadric::down;
  middle_ = depth(mid[0], mid[1], mid[2]);
  along_ = scaled(p[0], p[1], p[2], 1);
  across_ = scaled(v[0], v[1], v[2], 1);
  return true;
}

bool SpanForm::set(const ConvexShape& shape) {
  reach_ = shape.reach;
  for (int i = 0; i < 3; ++i) {
    origin_[i] = shape.origin[i];
    if (reach_.high[i] - reach_.low[i] > kFloatReach) return false;
    // Curved shapes square their distances from the origin, which must not lie far away.
    const bool curved = shape.kind == SolidKind::round || shape.kind == SolidKind::sphere;
    if (curved && shape.extent[i] > kFloatReach) return false;
  }
  top_word_ = floor_div(reach_.high[2] - 1, 32);
  f_top_ = static_cast<float>(32 * (top_word_ + 1) - reach_.high[2]);
  f_bottom_ = static_cast<float>(32 * (top_word_ + 1) - reach_.low[2]);
  slabs_ = lowers_ = uppers_ = limits_ = 0;
  upright_ = false;
  quadric_ = Quadric::none;
  if (shape.kind == SolidKind::prism) {  // its caps are drawn as planes
    const double* n = shape.l[1];
    const double back[3] = {-n[0], -n[1], -n[2]};
    if (!add_half_space(n, 0.5 - shape.t[1]) || !add_half_space(back, 0.5 + shape.t[1])) return false;
  } else if (!set_slabs(shape)) {
    return false;
  }
  for (const Plane& p : shape.planes) {
    if (!add_half_space(p.normal.data(), p.offset)) return false;
  }
  if (shape.kind == SolidKind::sphere) set_sphere(shape);
  return shape.kind != SolidKind::round || set_round(shape);
}

void SpanForm::row_limits(std::int32_t first, float low[8], float high[8]) const {
  constexpr std::int32_t kFar = 1 << 20;
  for (int lane = 0; lane < 8; ++lane) {
    const double y = first + lane;
    double from = -kFar, to = kFar;
    for (int i = 0; i < limits_; ++i) {
      const double rest = limit_[i][2] - limit_[i][1] * y;
      if (std::abs(limit_[i][0]) * kFar <= 1e-6 * std::abs(limit_[i][1])) {  // along x: takes all of a row or none
        if (!(rest > 0)) to = -kFar;
      } else if (limit_[i][0] > 0) {
        to = std::min(to, rest / limit_[i][0]);
      } else {
        from = std::max(from, rest / limit_[i][0]);
      }
    }
    if (upright_) {
      const double away = ellipse_[2] * y + ellipse_[3], square = ellipse_[4] - away * away;
      const double middle_x = -(ellipse_[0] * y + ellipse_[1]), half = square > 0 ? std::sqrt(square) : -1;
      from = std::max(from, middle_x - half);
      to = std::min(to, middle_x + half);
    }
    low[lane] = static_cast<float>(ceil_clamped(from, -kFar, kFar)) - 0.5f;
    high[lane] = static_cast<float>(ceil_clamped(to, -kFar, kFar)) - 0.5f;
  }
}

}  // namespace espalier
