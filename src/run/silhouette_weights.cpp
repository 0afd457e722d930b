#include "run/silhouette_weights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "io/drawing_import.h"

namespace espalier {
namespace {

/// In pixels, signed: above 0 wanted.
std::vector<double> values_of(const Drawing& drawing, const ImageLayer& layer) {
  std::vector<double> values(drawing.values.begin(), drawing.values.end());
  for (std::size_t i = 0; i < values.size(); ++i) {
    double& v = values[i];
    const double alpha = drawing.alpha.empty() ? 1 : drawing.alpha[i];
    if (!drawing.signed_weights) v = alpha * (1 - (layer.meaning == ImageMeaning::both ? 2 : 1) * v);
    if (layer.meaning == ImageMeaning::both) continue;
    if (v < 0)
      throw Error(fmt::format("{}: a value must be >= 0 in an image of what is {}, got {} in column {} of row {}",
                              layer.path, layer.meaning == ImageMeaning::want ? "wanted" : "avoided", v,
                              i % drawing.width, i / drawing.width));
    if (layer.meaning == ImageMeaning::avoid) v = -v;
  }
  return values;
}

WeightImage degrees_of(const Drawing& drawing, const std::vector<double>& values, double full) {
  WeightImage image{drawing.width, drawing.height, {}};
  image.degrees.reserve(values.size());
  for (const double v : values)
    image.degrees.push_back(static_cast<std::int32_t>(std::floor(WeightImage::kFull * (v / full) + 0.5)));
  return image;
}

void require_size(const WeightImage& image, const WeightImage& first, const std::vector<ImageLayer>& layers,
                  std::size_t i) {
  if (image.width == first.width && image.height == first.height) return;
  throw Error(fmt::format("{}: must have the size of {}, {} x {} pixels, or the silhouette a size that both are "
                          "reduced to; got {} x {}",
                          layers[i].path, layers[0].path, first.width, first.height, image.width, image.height));
}

}  // namespace

SilhouetteWeights load_weights(const std::vector<ImageLayer>& layers,
                               const std::optional<std::array<std::uint32_t, 2>>& size) {
  CHECK(!layers.empty());
  std::vector<Drawing> drawings;
  std::vector<std::vector<double>> values;
  bool weighed = false;
  double most = 0;
  for (const ImageLayer& layer : layers) {
    drawings.push_back(load_drawing(layer.path));
    values.push_back(values_of(drawings.back(), layer));
    weighed = weighed || drawings.back().signed_weights;
    for (const double v : values.back()) most = std::max(most, std::abs(v));
  }
  SilhouetteWeights result;
  if (weighed && most > 0) result.full = most;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    WeightImage image = degrees_of(drawings[i], values[i], result.full);
    if (size) image = resized(image, (*size)[0], (*size)[1]);
    if (i == 0) {
      result.image = std::move(image);
      continue;
    }
    require_size(image, result.image, layers, i);
    for (std::size_t k = 0; k < image.degrees.size(); ++k) result.image.degrees[k] += image.degrees[k];
  }
  return result;
}

}  // namespace espalier
