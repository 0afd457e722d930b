#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/math.h"

namespace espalier {
namespace {

constexpr float kTanView = 0.24f;  // half the longer side: about 27 degrees across
constexpr float kNearest = 0.05f;  // of the scene's unit size, in front of the first point

/// Where a pinhole must stand along and across its axis. Exact: two lines touch the points, the eye is where they meet.
struct Fit {
  float back, aside;
};

}  // namespace

Vec3 Camera::direction(float x, float y) const {
  return glm::normalize(forward + (x * tan_x) * right + (y * tan_y) * up);
}

Camera frame_points(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, std::uint32_t width,
                    std::uint32_t height, float margin) {
  const float radians = static_cast<float>(kPi / 180);
  const float azimuth = azimuth_deg * radians, elevation = std::clamp(elevation_deg, -89.0f, 89.0f) * radians;
  Camera camera;
  camera.forward = -Vec3(cosine(elevation) * sine(azimuth), sine(elevation), cosine(elevation) * cosine(azimuth));
  camera.right = glm::normalize(glm::cross(camera.forward, Vec3(0, 1, 0)));
  camera.up = glm::cross(camera.right, camera.forward);
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  camera.tan_x = aspect >= 1 ? kTanView : kTanView * aspect;
  camera.tan_y = aspect >= 1 ? kTanView / aspect : kTanView;

  float closest = 1e30f;
  const auto fit = [&](const Vec3& axis, float tangent) {
    float low = 1e30f, high = -1e30f;
    for (const Vec3& p : points) {
      const float across = glm::dot(axis, p), ahead = glm::dot(camera.forward, p);
      low = std::min(low, across + tangent * ahead);
      high = std::max(high, across - tangent * ahead);
      closest = std::min(closest, ahead);
    }
    return Fit{(high - low) / (2 * tangent), (high + low) / 2};
  };
  if (points.empty()) {
    camera.eye = -5.0f * camera.forward;
    return camera;
  }
  const float inside = 1 - 2 * margin;
  const Fit x = fit(camera.right, camera.tan_x * inside), y = fit(camera.up, camera.tan_y * inside);
  const float back = std::max({x.back, y.back, kNearest - closest});
  camera.eye = x.aside * camera.right + y.aside * camera.up - back * camera.forward;
  return camera;
}

}  // namespace espalier
