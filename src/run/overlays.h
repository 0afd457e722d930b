#pragma once
// Overlays: what a model covers of each target, as pictures for people: pixels of silhouettes, voxels of volumes. What
// is covered the scoring kernels themselves say.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/overlay.h"
#include "render/voxel_overlay.h"
#include "score/silhouette_target.h"
#include "score/volume_target.h"

namespace espalier {

/// Pixels of a drawing: how many are wanted, to be left free, neither.
struct DrawingCounts {
  std::uint64_t wanted = 0, to_avoid = 0, indifferent = 0;
};
DrawingCounts count_drawing(const WeightImage& image);

/// The drawing as it is understood.
MarkedPixels mark_drawing(const WeightImage& image);
/// What `silhouette`, of the drawing's size, covers of it.
MarkedPixels mark_silhouette(const WeightImage& image, const PixelCanvas& silhouette);
MarkedPixels mark_silhouette(const SilhouetteTarget& target, std::span<const Instance> instances);
MarkedVoxels mark_voxels(const VolumeTarget& target, std::span<const Instance> instances);

/// Rows with swatches, counts and percent; kinds of which there are none are left out, but for the chief ones.
std::vector<LegendRow> legend_of_drawing(const DrawingCounts& counts);
std::vector<LegendRow> legend_of(const MarkedPixels& pixels);
/// `beyond`: voxels outside of the grid, as VolumeCounts counts them.
std::vector<LegendRow> legend_of(const MarkedVoxels& voxels, std::uint64_t beyond);

}  // namespace espalier
