#pragma once
// Vectors and affine frames. Right-handed, y up, column vectors; lengths in metres unless a name says otherwise.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace espalier {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using DVec3 = glm::dvec3;
using Mat3 = glm::mat3;  // column-major: m[c] is column c

/// An affine map p -> basis * p + origin. `world_from_shape` names read right to left.
struct Frame {
  Mat3 basis{1.0f};
  Vec3 origin{0.0f};

  Vec3 point(const Vec3& p) const { return basis * p + origin; }
  Vec3 vector(const Vec3& v) const { return basis * v; }
};

/// An axis-aligned box; empty while min > max in any component.
struct Bounds {
  Vec3 min{1e30f};
  Vec3 max{-1e30f};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void add(const Vec3& p) {
    min = Vec3(p.x < min.x ? p.x : min.x, p.y < min.y ? p.y : min.y, p.z < min.z ? p.z : min.z);
    max = Vec3(p.x > max.x ? p.x : max.x, p.y > max.y ? p.y : max.y, p.z > max.z ? p.z : max.z);
  }
  void add(const Bounds& b) {
    if (!b.empty()) add(b.min), add(b.max);
  }
  Vec3 size() const { return max - min; }
  Vec3 centre() const { return 0.5f * (min + max); }
};

}  // namespace espalier
