#pragma once
// Tube: the surface around a limb as one closed piece: rings at the joints, swept without twist along the axis, with
// continuous normals, and texture coordinates in metres.

#include <cstdint>
#include <span>

#include "model/limbs.h"
#include "model/mesh.h"

namespace espalier {

struct TubeLook {
  std::uint32_t sides = 8;  // >= 3
  /// Metres of bark that a picture covers: v is the length of the surface from the base over `metres`; around stands
  /// the whole number of pictures, at least 1, that fits the girth, another where the tube has grown much thinner. 0: a
  /// picture is as wide and as tall as the mean girth.
  float metres = 0;
};

/// Adds the tube around `joints` to a mesh with normals and uvs: closed by flat ends; a radius of 0 makes a point.
/// Joints that stand where the one before stands, or are not finite, are passed over; fewer than two that remain, or
/// nothing but radius 0, add nothing.
void add_tube(Mesh& mesh, std::span<const LimbJoint> joints, const TubeLook& look);

/// The joints of a limb with a collar where it leaves its host: the limb widens towards the host's surface and meets it
/// there, and begins within. What leaves nothing, is nearly as thick as its host, or is too short stays as it is.
std::vector<LimbJoint> with_collar(const Limb& limb);

/// Fewer joints for much the same tube: those that stand within `tolerance` radii of the line between their neighbours,
/// and as thick as that line is there to within 0.4 of that, are left out. Ends stay.
std::vector<LimbJoint> without_straight_joints(std::span<const LimbJoint> joints, float tolerance);

/// Triangles of a tube with so many joints, none of them of radius 0.
std::uint64_t tube_triangles(std::size_t joints, std::uint32_t sides);

}  // namespace espalier
