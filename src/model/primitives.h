#pragma once
// The built-in primitives as meshes for drawing and export. All fit the unit box centred on 0, with y as their axis:
// box, cylinder, cone (radius 0.5 at y = -0.5, top * 0.5 at y = +0.5), sphere, wedge (ramp up +z: full height at
// z = +0.5, none at z = -0.5), pyramid (square base at y = -0.5, apex at y = +0.5); quad and leaf are flat, facing z.

#include "grammar/graph.h"
#include "model/mesh.h"

namespace espalier {

/// A sphere with so many sides (>= 3) around its axis and half as many bands from pole to pole.
Mesh make_sphere(std::uint32_t sides);

/// The corners of a leaf's outline: 12, 6 or 4.
enum class LeafOutline : std::uint8_t { fine, plain, coarse };
/// A pointed outline that is widest below the middle; stem at y = -0.5, tip at y = +0.5.
Mesh make_leaf(LeafOutline outline);

/// The mesh of a primitive. `top` (cones; >= 0, clamped at 0) is the ratio of upper to lower radius, `sides` the facets
/// around the axis. Closed except quad and leaf.
Mesh make_primitive(MeshKind kind, float top, std::uint16_t sides);

}  // namespace espalier
