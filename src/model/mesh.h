#pragma once
// Mesh: an indexed triangle mesh in its own coordinates, and the few facts about it that others ask for.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"

namespace espalier {

using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise seen from outside

struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // per position, unit length; empty = flat shaded
  std::vector<Vec2> uvs;      // per position, as uv.h says; empty = none
  std::vector<Triangle> triangles;
  std::string source_hash;    // content_hash of the file it came from; empty for primitives
};

Bounds bounds(const Mesh& mesh);

/// Per position the index of one position that stands for all with equal coordinates (-0 equals 0).
std::vector<std::uint32_t> weld_by_position(const std::vector<Vec3>& positions);

/// Edges whose two directions are not used equally often once equal positions are welded; 0 = closed.
std::size_t open_edges(const Mesh& mesh);

/// Signed volume by the divergence theorem; positive when triangles face outwards. Cubic metres.
double volume(const Mesh& mesh);

/// Scales and moves the mesh so that its bounding box is the unit box centred on 0; flat axes stay flat (and centred).
void fit_to_unit_box(Mesh& mesh);

}  // namespace espalier
