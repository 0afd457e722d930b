#pragma once
// CurveField: distances, tangents and parameters of guiding curves on a grid, read by trilinear interpolation: an
// approximation of CurveFinder, quicker by the number of curves. Within a cell of where the nearest curve changes,
// distances are too small by up to half a cell's diagonal and tangents run into each other; within a cell of a curve
// distances are too large by as much. Elsewhere the error falls with the square of the cell. Blended tangents run into
// each other where the second nearest curve changes, too. Beyond the grid (a quarter of the curves' extent on every
// side) it asks the finder.
//
// Errors over sets of five random curves, not blended:   all places                   a cell or more from all that
//                                      median  95 %  greatest                             median  95 %
//   32 cells  distance, in cells       0.02    0.09  0.5                                  0.02    0.05
//             tangent, in degrees      0.03    20    180                                  0.02    1
//   64 cells  distance, in cells       0.01    0.05  0.6                                  0.01    0.03
//             tangent, in degrees      0.02    8     180                                  0.01    0.2

#include <array>
#include <cstdint>
#include <vector>

#include "score/curve_finder.h"
#include "score/guiding_curve.h"

namespace espalier {

class CurveField {
 public:
  /// Keeps a reference to the finder. `settings` valid, with field_cells > 0.
  CurveField(const CurveSettings& settings, const CurveFinder& finder);

  /// As CurveFinder's.
  CurvePoint nearest(const Vec3& p) const;
  float parameter_on(std::uint32_t curve, const Vec3& p) const;
  /// Edge of a cell, m.
  float cell() const { return cell_; }
  const Bounds& box() const { return box_; }

 private:
  using Four = float __attribute__((vector_size(16)));
  struct Place {
    std::size_t node = 0;  // the cell's first corner
    float x = 0, y = 0, z = 0;  // within the cell, 0..1
  };

  /// False beyond the grid.
  bool locate(const Vec3& p, Place& place) const;
  Vec3 node_at(std::size_t x, std::size_t y, std::size_t z) const;
  template <class T>
  T interpolate(const T* values, const Place& place) const;
  std::size_t nearest_node(const Place& place) const;

  const CurveFinder& finder_;
  Bounds box_;
  float cell_ = 1, per_cell_ = 1;
  std::array<std::size_t, 3> cells_{};
  std::size_t row_ = 0, slice_ = 0;    // nodes to the next y, z
  std::vector<Four> nearest_;          // tangent and distance, per node
  std::vector<std::uint8_t> curve_;    // the nearest one, per node
  std::vector<float> parameters_;      // per curve, per node
};

}  // namespace espalier
