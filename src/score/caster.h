#pragma once
// Caster: a mesh of the grammar as it casts outlines and shadows. Flat meshes count, unlike in volumes.

#include <array>
#include <cstdint>
#include <vector>

#include "model/model.h"
#include "score/fold_mesh.h"
#include "score/projection.h"

namespace espalier {

struct Caster {
  enum class Kind : std::uint8_t {
    nothing,  // no triangles
    sphere,   // radius 1/2
    round,   // cylinders and cones of at least kRoundFromSides sides (solid.h): radius 1/2 at y = -1/2, top / 2 at +1/2
    box,   // |x|, |y|, |z| <= 1/2
    convex,  // closed and convex, or flat with a convex border
    triangles,  // anything else
  };
  Kind kind = Kind::nothing;
  bool tapered = false;  // Instance::top scales x and z of what stands above y = 0
  std::vector<Vec3> corners;                        // all kinds but sphere and round, in mesh space
  std::vector<std::array<std::uint32_t, 2>> edges;  // box and convex: those where its faces bend, or its border
  std::vector<Triangle> triangles;                  // box, convex and triangles: the surface
  FoldMesh folds;                                   // convex and triangles: the same, unless tapered
};

Caster make_caster(const MeshRef& ref, const Mesh& mesh);
/// One per mesh of the table.
std::vector<Caster> make_casters(const MeshTable& meshes);

/// The ray meets the placed part at some t >= ray.least. Exact but for rounding in double precision, and slow: each
/// triangle, or the quadric, is tried.
bool meets(const Caster& caster, const Instance& instance, const PixelRay& ray);

}  // namespace espalier
