#pragma once
// Stage: what stands around the model. A light backdrop or one colour, a ground that only shows shadows, a large soft
// key light over the camera's left shoulder, and a sky that is brighter above.

#include <optional>

#include "base/vec.h"
#include "render/camera.h"
#include "render/sampling.h"

namespace espalier {

struct Stage {
  float ground_y = 0;
  bool ground = true;
  bool clear = false;              // what is behind the model shows nothing: its pixels are transparent
  std::optional<Vec3> background;  // linear light; none: the backdrop
  Vec3 to_key{0, 1, 0};            // unit
  const LightTables* tables = nullptr;
};

inline constexpr float kKeySpread = 0.10f;  // tangent of the key light's half angle

/// Key light for a camera: over its left shoulder, well above.
Stage make_stage(float ground_y, const Camera& camera);

/// Linear light of the backdrop at picture point (x, y) in [-1, 1].
Vec3 backdrop(const Stage& stage, const Vec2& picture);

/// Radiance that arrives from a direction, key light left out; below the horizon that of the ground.
Vec3 sky(const Vec3& direction);

/// What surfaces mirror: the sky, a soft box where the key light is, a lit wall.
Vec3 studio(const Vec3& direction, const Vec3& to_key);

Vec3 key_radiance();

/// Share of light left on the ground where the key is seen by `key` and the sky by `open` (0..1).
Vec3 ground_light(float key, float open);

}  // namespace espalier
