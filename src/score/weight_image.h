#pragma once
// WeightImage: what a silhouette should cover and what it should not. Every pixel wants to be covered, wants to be left
// free, or does not care, each to a degree.

#include <cstdint>
#include <string>
#include <vector>

namespace espalier {

/// Degrees in -kFull..kFull, row by row from the top left: above 0 wanted, below 0 to be left free.
struct WeightImage {
  static constexpr std::int32_t kFull = 65535;

  std::uint32_t width = 0, height = 0;
  std::vector<std::int32_t> degrees;

  std::int32_t at(std::uint32_t column, std::uint32_t row) const {
    return degrees[std::size_t{row} * width + column];
  }
};

/// From light in 0..1 (row by row) and alpha in 0..1 (empty: all 1): dark is wanted, light is not, mid-grey and what is
/// transparent do not matter: degree = round(kFull * alpha * (1 - 2 * light)).
WeightImage weights_from_light(std::uint32_t width, std::uint32_t height, const std::vector<float>& light,
                               const std::vector<float>& alpha);

/// The image at another size: every new pixel is the mean of the old ones that it covers, by area, rounded to a degree.
/// Throws Error for a size of 0 or beyond Projection::kMostPixels.
WeightImage resized(const WeightImage& image, std::uint32_t width, std::uint32_t height);

}  // namespace espalier
