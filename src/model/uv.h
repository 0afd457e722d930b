#pragma once
// Texture coordinates: u to the right, v upwards, (0, 0) at the picture's lower left corner, 1 its width and height.

#include "base/vec.h"
#include "model/mesh.h"

namespace espalier {

/// Which side of a box a surface looks to: 0..5 for +x -x +y -y +z -z; where two are as near, z before x before y.
int box_side(const Vec3& normal);

/// Where a point of a surface in the unit box centred on 0 falls on the picture that is laid on the side of the box
/// which the surface looks to. Seen from outside, pictures stand upright and are not mirrored.
Vec2 box_uv(const Vec3& position, const Vec3& normal);

/// The mesh with `uvs`: its own, or else those of box_uv for its bounding box; vertices that need several are split.
Mesh with_uvs(const Mesh& mesh);

}  // namespace espalier
