#include "score/subdivision.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace espalier {
namespace {

constexpr double kGrow = 1.001;
constexpr double kFlatShare = 1e-6;  // noise of exporters on planes, as in fit_to_unit_box

}  // namespace

Subdivision::Subdivision(const Bounds& box, std::uint32_t layers) : layers_(layers) {
  CHECK(layers >= 1 && layers <= kMostLayers);
  if (box.empty()) return;
  const DVec3 low(box.min), size = DVec3(box.max) - low;
  const double longest = std::max({size.x, size.y, size.z});
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    flat_[axis] = size[axis] <= kFlatShare * longest;
    const double voxel = kGrow * size[axis] / layers, first = low[axis] - 0.5 * (kGrow - 1) * size[axis];
    for (std::uint32_t i = 0; i <= layers; ++i) planes_[axis].push_back(first + i * voxel);
    if (flat_[axis]) continue;
    per_metre_[axis] = 1 / voxel;
    squares += voxel * voxel;
  }
  diagonal_ = std::sqrt(squares);
}

std::uint32_t Subdivision::layer(int axis, double coordinate) const {
  if (flat_[axis]) return layers_ / 2;
  const std::vector<double>& planes = planes_[axis];
  const double guess = (coordinate - planes[0]) * per_metre_[axis];
  auto i = static_cast<std::uint32_t>(std::clamp(guess, 0.0, static_cast<double>(layers_ - 1)));
  // The planes decide, whatever the rounding of the guess.
  while (i > 0 && coordinate < planes[i]) --i;
  while (i + 1 < layers_ && coordinate >= planes[i + 1]) ++i;
  return i;
}

}  // namespace espalier
