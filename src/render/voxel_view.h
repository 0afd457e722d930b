#pragma once
// Voxel view: marked voxels seen from the right above by parallel rays that walk through the grid.

#include "render/voxel_overlay.h"

namespace espalier {

/// A picture of exactly this size, the grid's box as lines in it. `samples`: along each side of a pixel.
Picture voxel_view(const MarkedVoxels& voxels, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                   Executor& executor);

}  // namespace espalier
