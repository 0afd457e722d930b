#pragma once
// Projection: how model space falls onto an image: by a pinhole camera, by parallel rays, or as a shadow on a plane. A
// 3x4 matrix takes a point to homogeneous pixels (X, Y, W): column X / W from the left edge, row Y / W from the top
// edge, both 0.5 at the middle of the first pixel; W > 0 before the camera.

#include <array>
#include <cstdint>

#include "base/vec.h"

namespace espalier {

struct Projection {
  std::array<std::array<double, 4>, 3> matrix{};
  double nearest = 0;  // what has a smaller W is not seen; parallel projections have W = 1 everywhere
  std::uint32_t width = 1, height = 1;  // pixels, 1..kMostPixels

  static constexpr std::uint32_t kMostPixels = 8192;  // per side

  /// (X, Y, W) of a point.
  DVec3 point(const DVec3& p) const { return vector(p) + DVec3(matrix[0][3], matrix[1][3], matrix[2][3]); }
  /// (X, Y, W) of a direction.
  DVec3 vector(const DVec3& v) const {
    return {row(0, v), row(1, v), row(2, v)};
  }

 private:
  double row(int r, const DVec3& v) const { return matrix[r][0] * v.x + matrix[r][1] * v.y + matrix[r][2] * v.z; }
};

/// Where a camera stands and what it looks at; `up` is not along the way there.
struct LookAt {
  DVec3 eye{0, 0, 10}, at{0, 0, 0}, up{0, 1, 0};
};

/// A pinhole: the vertical angle of view in degrees, above 0 and below 180; `nearest` > 0 in metres along the axis.
/// Throws Error for values out of range or a camera that looks at itself or along `up`.
Projection perspective(const LookAt& look, double fov_deg, double nearest, std::uint32_t width, std::uint32_t height);

/// Parallel rays along the axis: the picture is `tall` metres high. Throws Error likewise.
Projection orthographic(const LookAt& look, double tall, std::uint32_t width, std::uint32_t height);

/// The plane on which a shadow falls, and the rectangle of it that the picture shows: `tall` metres along `up`.
struct ShadowScreen {
  DVec3 centre{0, 0, 0}, normal{0, 1, 0}, up{0, 0, -1};
  double tall = 10;
};

/// The shadow that a sun casts, whose light travels along `direction`. Throws Error where light runs along the screen.
Projection sun_shadow(const DVec3& direction, const ShadowScreen& screen, std::uint32_t width, std::uint32_t height);
/// The shadow that a lamp casts; what is not between it and the screen's plane, or beyond, casts none. Throws Error
/// where the lamp lies in the plane.
Projection lamp_shadow(const DVec3& lamp, const ShadowScreen& screen, std::uint32_t width, std::uint32_t height);

/// The points that fall onto one point of the image: origin + t * direction for t >= least, where W = t (perspective),
/// or for all t (parallel: least is -infinity).
struct PixelRay {
  DVec3 origin, direction;
  double least;
};
PixelRay ray_through(const Projection& projection, double column, double row);

}  // namespace espalier
