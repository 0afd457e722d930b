#pragma once
// Surface scale: texture coordinates in metres for primitives whose surface says how many metres its picture covers
// (Material::metres), so that bark is as coarse on a twig as on a trunk.

#include <array>
#include <compare>
#include <cstdint>

#include "grammar/graph.h"
#include "model/mesh.h"

namespace espalier {

/// The size of a part, to the nearest eighth of an octave along each axis (4.5 % at most): parts of nearly one size
/// share a shape.
struct PartSize {
  static constexpr std::int16_t kNone = -32768;  // no length

  std::array<std::int16_t, 3> steps{kNone, kNone, kNone};

  PartSize() = default;
  /// By the lengths of the frame's axes.
  explicit PartSize(const Mat3& basis);
  /// In metres, again.
  Vec3 metres() const;
  auto operator<=>(const PartSize&) const = default;
};

/// The uvs of a primitive in the unit box, of `size` metres, such that 1 is `metres` on its surface: across and up each
/// face, up cones, and from pole to pole. Around cylinders, cones and spheres stands the nearest whole number of
/// pictures, at least one, by the mean girth. `top`: a cone's upper over its lower width. Files keep their own.
void scale_uvs(Mesh& mesh, MeshKind kind, float top, const Vec3& size, float metres);

/// Pictures of `metres` that stand around a girth: a whole number, at least 1.
float pictures_around(double girth, double metres);

}  // namespace espalier
