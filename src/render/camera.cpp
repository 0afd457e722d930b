#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "base/math.h"

namespace espalier {
namespace {

constexpr float kTanView = 0.24f;  // half the longer side: about 27 degrees across
constexpr float kNearest = 0.05f;  // of the scene's unit size, in front of the first point
constexpr float kClose = 8;        // from here on distances along a ray are exact enough
constexpr float kParallelBack = 4;  // parallel rays start behind all of the scene

/// Where a pinhole must stand along and across its axis. Exact: two lines touch the points, the eye is where they meet.
struct Fit {
  float back, aside;
};

float radians(float degrees) { return degrees * static_cast<float>(kPi / 180); }

/// The longer of the two sides gets `longer`.
Lens lens_with(float longer, std::uint32_t width, std::uint32_t height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return aspect >= 1 ? Lens{longer, longer / aspect} : Lens{longer * aspect, longer};
}

/// Parallel rays start behind the scene, whose size is 1, wherever the eye is.
void step_back(Camera& camera) {
  const float ahead = glm::dot(camera.eye, camera.forward);
  if (camera.parallel) camera.eye -= (ahead + kParallelBack) * camera.forward;
}

}  // namespace

Lens long_lens(std::uint32_t width, std::uint32_t height) { return lens_with(kTanView, width, height); }

Lens lens_of_angle(float fov_deg, std::uint32_t width, std::uint32_t height) {
  CHECK(fov_deg > 0 && fov_deg < 180);
  const float y = tangent(radians(fov_deg) / 2);
  return {y * static_cast<float>(width) / static_cast<float>(height), y};
}

Lens parallel_lens(float tall, std::uint32_t width, std::uint32_t height) {
  return {tall / 2 * static_cast<float>(width) / static_cast<float>(height), tall / 2, true};
}

Vec3 Camera::direction(float x, float y) const {
  return parallel ? forward : glm::normalize(forward + (x * tan_x) * right + (y * tan_y) * up);
}

float Camera::skipped() const {
  const float away2 = glm::dot(eye, eye);
  return away2 > kClose * kClose && !parallel ? std::sqrt(away2) - kClose : 0;
}

Ray Camera::ray(float x, float y) const {
  if (parallel) return {eye + (x * tan_x) * right + (y * tan_y) * up, forward};
  const float skip = skipped();
  if (!(skip > 0)) return {eye, direction(x, y)};
  const glm::dvec3 exact = glm::normalize(glm::dvec3(forward) + static_cast<double>(x * tan_x) * glm::dvec3(right) +
                                          static_cast<double>(y * tan_y) * glm::dvec3(up));
  return {Vec3(glm::dvec3(eye) + static_cast<double>(skip) * exact), Vec3(exact)};
}

Vec3 Camera::picture_point(const Vec3& p) const {
  const Vec3 seen = p - eye;
  const float ahead = glm::dot(seen, forward), scale = parallel ? 1 : 1 / ahead;
  return {glm::dot(seen, right) * scale / tan_x, glm::dot(seen, up) * scale / tan_y, ahead};
}

Camera camera_from_side(float azimuth_deg, float elevation_deg, const Lens& lens) {
  float ce, se, ca, sa;
  sin_cos(radians(azimuth_deg), sa, ca);
  sin_cos(radians(std::clamp(elevation_deg, -90.0f, 90.0f)), se, ce);
  Camera camera;
  camera.forward = -Vec3(ce * sa, se, ce * ca);
  camera.right = Vec3(ca, 0, -sa);
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tan_x = lens.x, camera.tan_y = lens.y, camera.parallel = lens.parallel;
  return camera;
}

Camera frame_points(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, const Lens& lens,
                    float margin) {
  Camera camera = camera_from_side(azimuth_deg, elevation_deg, lens);
  if (points.empty() || camera.parallel) {
    Bounds box;
    for (const Vec3& p : points) box.add(p);
    camera.eye = (box.empty() ? Vec3(0) : box.centre()) - 5.0f * camera.forward;
    step_back(camera);
    return camera;
  }
  float closest = 1e30f;
  const auto fit = [&](const Vec3& axis, float tan) {
    float low = 1e30f, high = -1e30f;
    for (const Vec3& p : points) {
      const float across = glm::dot(axis, p), ahead = glm::dot(camera.forward, p);
      low = std::min(low, across + tan * ahead);
      high = std::max(high, across - tan * ahead);
      closest = std::min(closest, ahead);
    }
    return Fit{(high - low) / (2 * tan), (high + low) / 2};
  };
  const float inside = 1 - 2 * margin;
  const Fit x = fit(camera.right, camera.tan_x * inside), y = fit(camera.up, camera.tan_y * inside);
  const float back = std::max({x.back, y.back, kNearest - closest});
  camera.eye = x.aside * camera.right + y.aside * camera.up - back * camera.forward;
  return camera;
}

Camera frame_points(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, std::uint32_t width,
                    std::uint32_t height, float margin) {
  return frame_points(points, azimuth_deg, elevation_deg, long_lens(width, height), margin);
}

Camera frame_turning(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, const Lens& lens,
                     float margin) {
  // Of each slice of heights the farthest from the axis, all around: whatever the number of frames.
  constexpr int kSlices = 256, kAround = 64;
  Bounds box;
  for (const Vec3& p : points) box.add(p);
  if (points.empty()) return frame_points(points, azimuth_deg, elevation_deg, lens, margin);
  float radius2[kSlices] = {};
  const float tall = box.max.y - box.min.y, slices_per_length = tall > 0 ? kSlices / tall : 0;
  for (const Vec3& p : points) {
    const int slice = std::clamp(static_cast<int>((p.y - box.min.y) * slices_per_length), 0, kSlices - 1);
    radius2[slice] = std::max(radius2[slice], p.x * p.x + p.z * p.z);
  }
  std::vector<Vec3> swept;
  for (int slice = 0; slice < kSlices; ++slice) {
    const float radius = std::sqrt(radius2[slice]);
    if (radius == 0 && slice > 0 && slice + 1 < kSlices) continue;
    const float low = box.min.y + tall * static_cast<float>(slice) / kSlices;
    for (int k = 0; k < kAround; ++k) {
      float s, c;
      sin_cos(static_cast<float>(2 * kPi / kAround) * (static_cast<float>(k) + 0.5f), s, c);
      swept.emplace_back(radius * s, low, radius * c);
      swept.emplace_back(radius * s, low + tall / kSlices, radius * c);
    }
  }
  return turned(frame_points(swept, 0, elevation_deg, lens, margin), Vec3(0), azimuth_deg);
}

Camera placed_camera(const Vec3& eye, const glm::dvec3& ahead, const Lens& lens, const Vec3& up) {
  const glm::dvec3 across = glm::cross(ahead, glm::dvec3(up));
  const double length = glm::length(ahead), level = glm::length(across);
  CHECK(length > 0);
  Camera camera;
  camera.eye = eye;
  camera.forward = Vec3(ahead / length);
  if (level > 1e-6 * length * glm::length(glm::dvec3(up))) camera.right = Vec3(across / level);
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tan_x = lens.x, camera.tan_y = lens.y, camera.parallel = lens.parallel;
  step_back(camera);
  return camera;
}

Camera turned(const Camera& camera, const Vec3& centre, float degrees) {
  float s, c;
  sin_cos(radians(degrees), s, c);
  const auto turn = [&](const Vec3& v) { return Vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
  Camera out = camera;
  out.eye = centre + turn(camera.eye - centre), out.right = turn(camera.right), out.up = turn(camera.up);
  out.forward = turn(camera.forward);
  return out;
}

}  // namespace espalier
