#include "score/weight_image.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "score/projection.h"

namespace espalier {
namespace {

/// How much of each old pixel along one side a new one covers.
struct Cover {
  std::uint32_t first;
  std::vector<double> share;  // adds up to 1
};

std::vector<Cover> covers(std::uint32_t from, std::uint32_t to) {
  std::vector<Cover> all;
  const double scale = static_cast<double>(from) / to;
  for (std::uint32_t i = 0; i < to; ++i) {
    const double low = i * scale, high = (i + 1) * scale;
    Cover cover{std::min(static_cast<std::uint32_t>(low), from - 1), {}};
    for (std::uint32_t k = cover.first; k < from && k < high; ++k)
      cover.share.push_back((std::min<double>(k + 1, high) - std::max<double>(k, low)) / scale);
    all.push_back(std::move(cover));
  }
  return all;
}

}  // namespace

WeightImage weights_from_light(std::uint32_t width, std::uint32_t height, const std::vector<float>& light,
                               const std::vector<float>& alpha) {
  CHECK(light.size() == std::size_t{width} * height && (alpha.empty() || alpha.size() == light.size()));
  WeightImage image{width, height, {}};
  image.degrees.reserve(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double a = alpha.empty() ? 1 : std::clamp(alpha[i], 0.0f, 1.0f);
    const double l = std::clamp(light[i], 0.0f, 1.0f);
    image.degrees.push_back(static_cast<std::int32_t>(std::floor(WeightImage::kFull * a * (1 - 2 * l) + 0.5)));
  }
  return image;
}

WeightImage resized(const WeightImage& image, std::uint32_t width, std::uint32_t height) {
  if (width < 1 || height < 1 || width > Projection::kMostPixels || height > Projection::kMostPixels)
    throw Error(fmt::format("an image is reduced to 1 to {} pixels per side, not {} x {}", Projection::kMostPixels,
                            width, height));
  if (width == image.width && height == image.height) return image;
  const std::vector<Cover> columns = covers(image.width, width), rows = covers(image.height, height);
  WeightImage out{width, height, {}};
  out.degrees.reserve(std::size_t{width} * height);
  for (const Cover& row : rows) {
    for (const Cover& column : columns) {
      double sum = 0;
      for (std::size_t y = 0; y < row.share.size(); ++y)
        for (std::size_t x = 0; x < column.share.size(); ++x)
          sum += row.share[y] * column.share[x] *
                 image.at(column.first + static_cast<std::uint32_t>(x), row.first + static_cast<std::uint32_t>(y));
      out.degrees.push_back(static_cast<std::int32_t>(std::floor(sum + 0.5)));
    }
  }
  return out;
}

}  // namespace espalier
