#pragma once
// Lattice: the coordinates that kernels work in. Voxel (x, y, z) is sampled at the integer point (x, y, z): model space
// scaled to cells, moved by half a cell and by the sampling nudge. A solid covers the integers in [ceil(lo), ceil(hi)).

#include <cstdint>

#include "base/vec.h"
#include "score/voxel_grid.h"

namespace espalier {

struct Lattice {
  double scale[3];      // cells per metre
  double origin[3];     // of the grid, in metres
  double centre[3];     // half a cell and the nudge, in cells
  std::int32_t cells[3];
  std::int32_t low[3];  // the window beyond which nothing is counted: integers in [low, high)
  std::int32_t high[3];

  explicit Lattice(const VoxelGrid& grid) {
    for (int i = 0; i < 3; ++i) {
      origin[i] = double{grid.min[i]};
      scale[i] = grid.cells[i] / (double{grid.max[i]} - double{grid.min[i]});
      centre[i] = 0.5 + kSampleNudge[i];
      cells[i] = static_cast<std::int32_t>(grid.cells[i]);
      low[i] = -kWindowGrids * cells[i];
      high[i] = (kWindowGrids + 1) * cells[i];
    }
  }
};

/// A mesh space seen from the lattice: lattice = m * mesh + o, rows are lattice axes.
struct GridPlacement {
  double m[3][3];
  double o[3];

  double at(int axis, const Vec3& p) const {
    return m[axis][0] * double{p.x} + m[axis][1] * double{p.y} + m[axis][2] * double{p.z} + o[axis];
  }
};

/// Parts that reach further than this many cells are not drawn; their squares still fit a double with room to spare.
inline constexpr double kFarthest = 1e30;

/// False if the frame is not finite or beyond kFarthest.
inline bool place(const Lattice& lattice, const Frame& model_from_mesh, GridPlacement& placement) {
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double v = double{model_from_mesh.basis[j][i]} * lattice.scale[i];
      placement.m[i][j] = v;
      most += v < 0 ? -v : v;
    }
    const double v = (double{model_from_mesh.origin[i]} - lattice.origin[i]) * lattice.scale[i] - lattice.centre[i];
    placement.o[i] = v;
    most += v < 0 ? -v : v;
  }
  return most < kFarthest;  // false for NaN
}

/// ceil(v), clamped to [low, high] (any finite or infinite v; NaN gives low).
inline std::int32_t ceil_clamped(double v, std::int32_t low, std::int32_t high) {
  if (!(v > low)) return low;
  if (v >= high) return high;
  const auto i = static_cast<std::int32_t>(v);
  return i + (v > i ? 1 : 0);
}

/// A box of lattice points, [low, high) on each axis.
struct Reach {
  std::int32_t low[3];
  std::int32_t high[3];

  bool empty() const { return low[0] >= high[0] || low[1] >= high[1] || low[2] >= high[2]; }
  bool inside(const Lattice& lattice) const {
    for (int i = 0; i < 3; ++i) {
      if (low[i] < 0 || high[i] > lattice.cells[i]) return false;
    }
    return true;
  }
  std::uint64_t volume() const {
    if (empty()) return 0;
    return std::uint64_t(high[0] - low[0]) * std::uint64_t(high[1] - low[1]) * std::uint64_t(high[2] - low[2]);
  }
  Reach in_grid(const Lattice& lattice) const {
    Reach r = *this;
    for (int i = 0; i < 3; ++i) {
      r.low[i] = r.low[i] < 0 ? 0 : r.low[i];
      r.high[i] = r.high[i] > lattice.cells[i] ? lattice.cells[i] : r.high[i];
    }
    return r;
  }
};

/// The lattice points within centre +- half, clipped to the window.
inline Reach reach_of(const Lattice& lattice, const double centre[3], const double half[3]) {
  Reach r;
  for (int i = 0; i < 3; ++i) {
    r.low[i] = ceil_clamped(centre[i] - half[i], lattice.low[i], lattice.high[i]);
    r.high[i] = ceil_clamped(centre[i] + half[i], lattice.low[i], lattice.high[i]);
  }
  return r;
}

}  // namespace espalier
