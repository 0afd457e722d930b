#include "score/reference_silhouette.h"

namespace espalier {

PixelCanvas reference_silhouette(const Projection& projection, const std::vector<Caster>& casters,
                                 std::span<const Instance> instances, VolumeView view) {
  PixelCanvas canvas(projection.width, projection.height);
  for (std::uint32_t row = 0; row < projection.height; ++row) {
    for (std::uint32_t column = 0; column < projection.width; ++column) {
      const Ray ray = ray_through(projection, column + 0.5, row + 0.5);
      for (const Instance& instance : instances) {
        if (!(view == VolumeView::full ? in_full(instance) : in_parts(instance))) continue;
        if (!meets(casters[instance.mesh], instance, ray)) continue;
        canvas.set(column, row);
        break;
      }
    }
  }
  return canvas;
}

SilhouetteCounts reference_counts(const PixelCanvas& silhouette, const WeightImage& image) {
  SilhouetteCounts counts;
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column) {
      if (!silhouette.get(column, row)) continue;
      const std::int64_t degree = image.at(column, row);
      ++counts.covered;
      if (degree > 0) ++counts.wanted, counts.wanted_sum += static_cast<std::uint64_t>(degree);
      if (degree < 0) ++counts.free, counts.free_sum += static_cast<std::uint64_t>(-degree);
    }
  }
  return counts;
}

}  // namespace espalier
