#include "score/projection.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "base/error.h"

namespace espalier {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;

struct Axes {
  DVec3 right, up, out;  // unit; `out` points from the picture to its viewer
};

void check_size(std::uint32_t width, std::uint32_t height) {
  for (const std::uint32_t side : {width, height}) {
    if (side < 1 || side > Projection::kMostPixels)
      throw Error(fmt::format("a picture has 1 to {} pixels per side, got {} x {}", Projection::kMostPixels, width,
                              height));
  }
}

bool finite(const DVec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Axes axes_of(const DVec3& out, const DVec3& up, const char* what) {
  const double length = glm::length(out);
  const DVec3 across = glm::cross(up, out);
  if (!finite(out) || !finite(up) || !(length > 0) || !(glm::length(across) > 1e-9 * length * glm::length(up))) {
    throw Error(fmt::format("{}: its direction ({}, {}, {}) must not be 0 or along its up ({}, {}, {})", what, out.x,
                            out.y, out.z, up.x, up.y, up.z));
  }
  Axes axes;
  axes.out = out / length;
  axes.right = glm::normalize(across);
  axes.up = glm::cross(axes.out, axes.right);
  return axes;
}

/// Sets a row to a . p + b.
void set_row(Projection& p, int row, const DVec3& a, double b) { p.matrix[row] = {a.x, a.y, a.z, b}; }

Projection sized(std::uint32_t width, std::uint32_t height) {
  check_size(width, height);
  Projection p;
  p.width = width, p.height = height;
  return p;
}

/// X and Y from the coordinates s and t of a picture `tall` high, centred at 0, with W = (w, w0).
void set_window(Projection& p, double tall, const DVec3& s, double s0, const DVec3& t, double t0, const DVec3& w,
                double w0) {
  const double scale = p.height / tall;
  set_row(p, 0, scale * s + 0.5 * p.width * w, scale * s0 + 0.5 * p.width * w0);
  set_row(p, 1, -scale * t + 0.5 * p.height * w, -scale * t0 + 0.5 * p.height * w0);
  set_row(p, 2, w, w0);
}

void check_tall(double tall) {
  if (!(tall > 0) || !std::isfinite(tall)) throw Error(fmt::format("a picture's height must be > 0, got {}", tall));
}

}  // namespace

Projection perspective(const LookAt& look, double fov_deg, double nearest, std::uint32_t width, std::uint32_t height) {
  Projection p = sized(width, height);
  if (!(fov_deg > 0 && fov_deg < 180)) throw Error(fmt::format("fov must be above 0 and below 180, got {}", fov_deg));
  if (!(nearest > 0) || !std::isfinite(nearest)) throw Error(fmt::format("near must be > 0, got {}", nearest));
  const Axes axes = axes_of(look.eye - look.at, look.up, "camera");
  const DVec3& e = look.eye;
  // At distance W the picture is 2 W tan(fov / 2) high.
  set_window(p, 2 * std::tan(0.5 * fov_deg * kRadians), axes.right, -glm::dot(axes.right, e), axes.up,
             -glm::dot(axes.up, e), -axes.out, glm::dot(axes.out, e));
  p.nearest = nearest;
  return p;
}

Projection orthographic(const LookAt& look, double tall, std::uint32_t width, std::uint32_t height) {
  Projection p = sized(width, height);
  check_tall(tall);
  const Axes axes = axes_of(look.eye - look.at, look.up, "camera");
  set_window(p, tall, axes.right, -glm::dot(axes.right, look.at), axes.up, -glm::dot(axes.up, look.at), DVec3(0), 1);
  p.nearest = 0.5;
  return p;
}

Projection sun_shadow(const DVec3& direction, const ShadowScreen& screen, std::uint32_t width, std::uint32_t height) {
  Projection p = sized(width, height);
  check_tall(screen.tall);
  const Axes axes = axes_of(screen.normal, screen.up, "shadow screen");
  const double fall = glm::dot(direction, axes.out);
  if (!finite(direction) || !(std::abs(fall) > 1e-6 * glm::length(direction)))
    throw Error(fmt::format("light along ({}, {}, {}) never meets the shadow's plane", direction.x, direction.y,
                            direction.z));
  // q = p - direction * (out . (p - c)) / fall, so q . right = (right - out * slide) . p + ...
  const auto across = [&](const DVec3& axis) { return axis - axes.out * (glm::dot(direction, axis) / fall); };
  const DVec3 s = across(axes.right), t = across(axes.up);
  set_window(p, screen.tall, s, -glm::dot(s, screen.centre), t, -glm::dot(t, screen.centre), DVec3(0), 1);
  p.nearest = 0.5;
  return p;
}

Projection lamp_shadow(const DVec3& lamp, const ShadowScreen& screen, std::uint32_t width, std::uint32_t height) {
  Projection p = sized(width, height);
  check_tall(screen.tall);
  const Axes axes = axes_of(screen.normal, screen.up, "shadow screen");
  const double high = glm::dot(lamp - screen.centre, axes.out);
  if (!finite(lamp) || !(std::abs(high) > 1e-9)) throw Error("the lamp lies in the plane of its shadow");
  // W = (out . (lamp - p)) / high: 0 at the lamp, 1 on the plane; q = lamp + (p - lamp) / W.
  const DVec3 w = -axes.out / high;
  const double w0 = glm::dot(axes.out, lamp) / high;
  const auto shifted = [&](const DVec3& axis) { return axis + w * glm::dot(axis, lamp - screen.centre); };
  const auto constant = [&](const DVec3& axis) {
    return -glm::dot(axis, lamp) + w0 * glm::dot(axis, lamp - screen.centre);
  };
  set_window(p, screen.tall, shifted(axes.right), constant(axes.right), shifted(axes.up), constant(axes.up), w, w0);
  p.nearest = 1e-3;
  return p;
}

Ray ray_through(const Projection& p, double column, double row) {
  const DVec3 x(p.matrix[0][0], p.matrix[0][1], p.matrix[0][2]), y(p.matrix[1][0], p.matrix[1][1], p.matrix[1][2]);
  const DVec3 w(p.matrix[2][0], p.matrix[2][1], p.matrix[2][2]);
  if (w == DVec3(0)) {  // parallel: x . p = column - b, y . p = row - b
    const DVec3 along = glm::cross(x, y);
    const glm::dmat3 rows = glm::transpose(glm::dmat3(x, y, along));
    const DVec3 origin = glm::inverse(rows) * DVec3(column - p.matrix[0][3], row - p.matrix[1][3], 0);
    return {origin, glm::normalize(along), -std::numeric_limits<double>::infinity()};
  }
  const glm::dmat3 inverse = glm::inverse(glm::transpose(glm::dmat3(x, y, w)));
  const DVec3 eye = inverse * -DVec3(p.matrix[0][3], p.matrix[1][3], p.matrix[2][3]);
  return {eye, inverse * DVec3(column, row, 1), p.nearest};
}

}  // namespace espalier
