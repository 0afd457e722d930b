#pragma once
// Placement: translation, rotation and scale of a node. glTF allows no other transform of a node, so a frame that
// shears has none.

#include <array>
#include <optional>

#include "base/vec.h"

namespace espalier {

struct Placement {
  Vec3 translation{0};
  std::array<float, 4> rotation{0, 0, 0, 1};  // unit quaternion x, y, z, w; w >= 0
  Vec3 scale{1};                              // mirrored frames: x negative
};

/// The placement that equals `frame` to about 3e-5 of the part's size for shapes in `shape_box`; none if the frame
/// shears, or is flat where the shape is not. Along an axis where the shape itself is flat the frame does not matter.
std::optional<Placement> find_placement(const Frame& frame, const Bounds& shape_box);

}  // namespace espalier
