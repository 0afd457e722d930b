#pragma once
// The slow way to see a silhouette: one ray per pixel against every part. What the kernel is tested against.

#include <span>
#include <vector>

#include "score/silhouette_kernel.h"

namespace espalier {

/// The pixels whose middles some part that `view` shows covers.
PixelCanvas reference_silhouette(const Projection& projection, const std::vector<Caster>& casters,
                                 std::span<const Instance> instances, VolumeView view);

/// What SilhouetteKernel::sweep makes of it.
SilhouetteCounts reference_counts(const PixelCanvas& silhouette, const WeightImage& image);

}  // namespace espalier
