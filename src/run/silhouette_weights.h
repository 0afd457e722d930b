#pragma once
// The images of a silhouette as weights: what is wanted and what is to be left free.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "score/weight_image.h"

namespace espalier {

/// How an image says what is wanted: v = light of a drawing (0..1) or value of a PFM file, a = alpha.
enum class ImageMeaning : std::uint8_t {
  both,   // drawings: a (1 - 2 v): dark is wanted, light is not, mid-grey does not matter; PFM: v
  want,   // drawings: a (1 - v); PFM: v >= 0
  avoid,  // the same with the other sign
};

struct ImageLayer {
  std::string path;
  ImageMeaning meaning = ImageMeaning::both;
};

struct SilhouetteWeights {
  WeightImage image;
  /// The pixels that a degree of WeightImage::kFull stands for: 1, or where a PFM file has part in it the greatest
  /// absolute value of all.
  double full = 1;
};

/// The sum of the layers, reduced to `size` (columns, rows) if that is given. Throws Error naming the file: one that
/// cannot be read, is of another size than the others where no size is given, or has values below 0 where only those
/// from 0 mean something.
SilhouetteWeights load_weights(const std::vector<ImageLayer>& layers,
                               const std::optional<std::array<std::uint32_t, 2>>& size);

}  // namespace espalier
