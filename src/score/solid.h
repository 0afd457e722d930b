#pragma once
// Solid: a mesh of the grammar as the voxel kernel sees it. Shapes that a row along z enters once are described exactly
// (planes, quadrics); everything else keeps its triangles.

#include <array>
#include <cstdint>
#include <vector>

#include "model/model.h"

namespace espalier {

enum class SolidKind : std::uint8_t {
  nothing,  // flat: no volume
  box,      // |x|, |y|, |z| <= 1/2
  sphere,   // radius 1/2
  round,    // cylinder and cone with many sides: radius 1/2 at y = -1/2, top / 2 at y = +1/2
  prism,    // the same with few sides, as drawn: planes
  convex,   // closed convex mesh: planes
  facets,   // any other mesh: parity of crossings
};

/// Cylinders and cones with at least this many sides count as round, with fewer as the polyhedra that are drawn.
inline constexpr std::uint16_t kRoundFromSides = 12;

/// The half space normal . p <= offset, in mesh space.
struct Plane {
  std::array<double, 3> normal;
  double offset;
};

struct Solid {
  /// Convex meshes with more different planes than this are counted by their triangles.
  static constexpr std::size_t kMostPlanes = 64;

  SolidKind kind = SolidKind::nothing;
  bool tapered = false;  // round, prism: Instance::top applies
  double centre[3] = {0, 0, 0}, half[3] = {0, 0, 0};  // the mesh's bounding box (with top = 1)
  std::vector<Plane> planes;  // convex: all; prism: the sides at top = 1, with normals in x and z
  Mesh mesh;                  // facets
};

/// The solid of one mesh of a grammar.
Solid make_solid(const MeshRef& ref, const Mesh& mesh);

/// The planes of a closed convex mesh, equal ones merged; empty if it is not closed, not convex, or has too many.
std::vector<Plane> convex_planes(const Mesh& mesh);

/// One solid per mesh of the table.
std::vector<Solid> make_solids(const MeshTable& meshes);

}  // namespace espalier
