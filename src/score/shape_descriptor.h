#pragma once
// ShapeDescriptor: a shape as a grid of histograms: in each voxel, how far apart two random points of the surface are.
// Subdivided D2, after Controlling Procedural Modelling Interactively with Guiding Curves (2018), section 5.1; D2 is of
// Osada et al., Shape Distributions (2002). Depends on pose by intent: it is for models that shall resemble each other
// as they stand.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/executor.h"
#include "model/shell.h"
#include "score/subdivision.h"

namespace espalier {

struct DescriptorSettings {
  static constexpr std::uint32_t kMostPairs = 100'000, kMostBins = 100;
  static constexpr std::uint64_t kMostPairsInAll = 1u << 23;  // of a grid; about 80 bytes each while they are drawn
  static constexpr double kLeastRange = 1e-9, kMostRange = 1e9;  // m

  std::uint32_t layers = 4;  // of the grid along each axis, 1 to Subdivision::kMostLayers
  /// Of points per voxel, 1 to kMostPairs. They set the noise: of a surface to itself with other points the median
  /// distance, over voxels with surface, is about 0.7 / sqrt(pairs): 0.12 with 30, 0.02 with 1000 (docs/tools.md).
  std::uint32_t pairs = 30;
  std::uint32_t bins = 10;   // of a histogram, 2 to kMostBins; equally wide, from 0 to `range`
  /// In metres, kLeastRange to kMostRange; longer distances count in the last bin. Without it the diagonal of a voxel,
  /// the longest distance there is, so that size does not count. Published: 1.5, for models of a few metres: that is
  /// the diagonal of a voxel for a cube of 3.5 m.
  std::optional<double> range;
  std::uint64_t seed = 1;
  std::uint32_t draw = 0;  // another one draws other points from the same seed
  /// Into which the voxels may cut the triangles, all together: a minute's work.
  std::uint64_t most_pieces = 250'000'000;
};

/// Throws Error with rule and value.
void validate(const DescriptorSettings& settings);

struct ShapeDescriptor {
  std::uint32_t layers = 0, pairs = 0, bins = 0;
  std::vector<std::uint32_t> counts;  // [voxel][bin]: each voxel's sum is `pairs`, or 0 where there is no surface
  std::vector<double> areas;          // [voxel], m2

  bool operator==(const ShapeDescriptor&) const = default;
};

/// The descriptor of a shell whose triangles lie in the box of `grid`. Points are drawn evenly from the surface,
/// exactly: triangles are cut at the voxels' faces and points are drawn from the pieces. A voxel's points depend only
/// on seed, draw, voxel, and the surface in it, so voxels with the same surface are equal. The same bytes for any
/// number of threads. Throws Error for bad settings and where there are too many pieces. Time: two passes over the
/// triangles, about 0.1 us for each piece; memory: 80 bytes per pair, nothing per triangle.
ShapeDescriptor describe(const Shell& shell, const Subdivision& grid, const DescriptorSettings& settings,
                         Executor& executor);

/// Kolmogorov and Smirnov's distance per voxel: the largest difference of the two shares of distances up to a bin's
/// end, for every bin; a multiple of 1 / pairs in [0, 1]. An empty voxel has an empty histogram, whose share is 0
/// throughout, so: 0 where both are empty, 1 where one is. Both must have the same layers, pairs and bins.
std::vector<double> voxel_distances(const ShapeDescriptor& a, const ShapeDescriptor& b);

}  // namespace espalier
