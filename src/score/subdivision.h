#pragma once
// Subdivision: the box around a surface, cut into n x n x n equal voxels, on which shapes are described.

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace espalier {

/// Voxel (x, y, z) is half-open: what lies on the plane between two belongs to the upper one. Linear order: x fastest,
/// then y, then z.
class Subdivision {
 public:
  static constexpr std::uint32_t kMostLayers = 16;

  /// `box`: around all that will be asked for (empty: nothing will); grows by 0.1 % about its middle, so that the
  /// outermost faces lie inside (Guiding curves 2018, section 5.1, as built there). An axis along which the box is
  /// flat, less than a millionth of its longest side, is not cut: all lies in its middle layer, n / 2. `layers`: n, 1
  /// to kMostLayers.
  Subdivision(const Bounds& box, std::uint32_t layers);

  std::uint32_t layers() const { return layers_; }
  std::uint32_t voxel_count() const { return layers_ * layers_ * layers_; }
  std::uint32_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + layers_ * (y + layers_ * z);
  }
  /// In which layer of an axis a coordinate lies, 0 to n - 1; metres in model space.
  std::uint32_t layer(int axis, double coordinate) const;
  /// Where layer `i` of an axis begins; i = n: where the last one ends.
  double plane(int axis, std::uint32_t i) const { return planes_[axis][i]; }
  /// The longest way within a voxel, m; 0 only where nothing is held.
  double diagonal() const { return diagonal_; }

 private:
  std::uint32_t layers_ = 1;
  bool flat_[3] = {true, true, true};
  double per_metre_[3] = {0, 0, 0};  // layers
  std::vector<double> planes_[3];    // layers_ + 1 each, ascending
  double diagonal_ = 0;
};

}  // namespace espalier
