#pragma once
// The corners of boxes along the axes.

#include "base/vec.h"

namespace espalier {

/// k = 0..7: bit 0 stands for x, 1 for y, 2 for z; set where the corner has the greater coordinate.
inline Vec3 corner_of(const Bounds& box, int k) {
  return {k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z};
}

}  // namespace espalier
