#pragma once
// VoxelCutter: what of a triangle lies in each voxel of a subdivision.

#include <algorithm>
#include <cstdint>

#include "score/polygon.h"
#include "score/subdivision.h"

namespace espalier {

/// Holds scratch memory of one thread. The subdivision must outlive it.
class VoxelCutter {
 public:
  /// Only voxels whose layer along z is in [first, last) are told. What is told of them does not depend on the range.
  VoxelCutter(const Subdivision& grid, std::uint32_t first, std::uint32_t last)
      : grid_(grid), first_(first), last_(last) {}

  /// Calls visit(voxel, polygon, area) for each voxel in which the triangle has an area, in ascending order; areas in
  /// m2, above 0. The triangle lies in the box of the subdivision.
  template <class Visit>
  void cut_up(const DVec3& a, const DVec3& b, const DVec3& c, const Visit& visit) {
    for (int axis = 0; axis < 3; ++axis) {
      from_[axis] = grid_.layer(axis, std::min({a[axis], b[axis], c[axis]}));
      to_[axis] = grid_.layer(axis, std::max({a[axis], b[axis], c[axis]}));
    }
    if (to_[2] < first_ || from_[2] >= last_) return;
    along(2, 0, Polygon(a, b, c), visit);
  }

 private:
  /// Cuts a polygon into the layers of an axis, and each of them into those of the axes before.
  template <class Visit>
  void along(int axis, std::uint32_t voxel, const Polygon& polygon, const Visit& visit) {
    if (axis < 0) {
      if (const double area = polygon.area(); area > 0) visit(voxel, polygon, area);
      return;
    }
    if (from_[axis] == to_[axis]) return along(axis - 1, voxel * grid_.layers() + from_[axis], polygon, visit);
    Polygon layer, rest = polygon, above;
    for (std::uint32_t i = from_[axis]; i <= to_[axis] && rest.count() >= 3; ++i) {
      if (axis == 2 && i >= last_) return;
      const bool last = i == to_[axis];
      // Always plane by plane from the lowest, or the range would show in the last bits.
      if (!last) cut(rest, axis, grid_.plane(axis, i + 1), layer, above);
      if (axis < 2 || i >= first_) {
        const Polygon& here = last ? rest : layer;
        if (here.count() >= 3) along(axis - 1, voxel * grid_.layers() + i, here, visit);
      }
      if (!last) rest = above;
    }
  }

  const Subdivision& grid_;
  std::uint32_t first_, last_;
  std::uint32_t from_[3] = {0, 0, 0}, to_[3] = {0, 0, 0};  // layers of the triangle's box
};

}  // namespace espalier
