#include "render/stage.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

Vec3 mix(const Vec3& a, const Vec3& b, float t) { return a + t * (b - a); }

float smooth(float x) {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

}  // namespace

Stage make_stage(float ground_y, const Camera& camera) {
  // Over the left shoulder and well above: 50 degrees aside, 50 up.
  const Vec3 back = glm::cross(camera.right, Vec3(0, 1, 0));
  Stage stage;
  stage.ground_y = ground_y;
  stage.to_key = glm::normalize(0.55f * back - 0.62f * camera.right + Vec3(0, 1.0f, 0));
  stage.tables = &LightTables::shared();
  return stage;
}

Vec3 backdrop(const Stage& stage, const Vec2& picture) {
  if (stage.clear) return Vec3(0);
  if (stage.background) return *stage.background;
  const float x = picture.x, y = picture.y + 0.15f, away = 0.42f * x * x + 0.5f * y * y;
  const Vec3 middle(0.78f, 0.78f, 0.775f), rim(0.43f, 0.44f, 0.46f);
  return mix(middle, rim, smooth(away));
}

Vec3 sky(const Vec3& direction) {
  const Vec3 zenith(0.50f, 0.54f, 0.60f), horizon(0.33f, 0.345f, 0.36f), ground(0.27f, 0.265f, 0.26f);
  return direction.y > 0 ? mix(horizon, zenith, smooth(direction.y)) : mix(horizon, ground, smooth(-3 * direction.y));
}

Vec3 studio(const Vec3& direction, const Vec3& to_key) {
  const float box = smooth((glm::dot(direction, to_key) - 0.55f) / 0.3f);
  const float strip = smooth(1 - std::abs(direction.y - 0.25f) / 0.2f);  // a lit wall all around
  return 1.1f * sky(direction) + Vec3(0.9f * box + 0.45f * strip);
}

Vec3 key_radiance() { return {0.94f, 0.89f, 0.82f}; }

Vec3 ground_light(float key, float open) {
  const Vec3 from_key(0.50f, 0.48f, 0.45f), from_sky(0.50f, 0.52f, 0.55f);
  return key * from_key + open * from_sky;
}

}  // namespace espalier
