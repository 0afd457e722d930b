#pragma once
// SilhouetteKernel: the fast way to see how a model's silhouette covers an image of weights. Round parts and boxes
// become outlines, eight at a time, and eight rows of an outline are drawn at a time as spans of bits; meshes are drawn
// by the edges at which they fold over. One sweep adds up the weights of what is covered. Runs on AVX2, SSE4, SSSE3 or
// without SIMD, chosen at run time, with equal results; reference_silhouette.h is what it is tested against.

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "score/fold_scratch.h"
#include "score/outline.h"
#include "score/pixel_canvas.h"
#include "score/target.h"
#include "score/volume_view.h"
#include "score/weight_image.h"

namespace espalier {

/// Pixels that the silhouette covers, and the sums of their degrees (WeightImage), all exact.
struct SilhouetteCounts {
  std::uint64_t covered = 0;           // pixels
  std::uint64_t wanted = 0, free = 0;  // of those: wanted, and to be left free
  std::uint64_t wanted_sum = 0, free_sum = 0;  // their degrees, both >= 0

  bool operator==(const SilhouetteCounts&) const = default;
};

/// The weights in tiles: which pixels are wanted or to be left free, and unless all degrees of a kind are alike, how
/// much.
struct WeightTiles {
  explicit WeightTiles(const WeightImage& image);

  PixelCanvas wanted, free;
  std::int32_t wanted_degree = 0, free_degree = 0;  // where alike
  bool graded = false;
  TileVector<std::int32_t> degrees;                 // graded: [tile][column % 32][row % 8], absolute
  std::vector<std::int64_t> wanted_of_tile, free_of_tile;  // graded: sums of full tiles
  SilhouetteCounts all;                             // of a silhouette that covers everything
};

/// What one thread sees with.
class SilhouetteScratch final : public TargetScratch {
 public:
  explicit SilhouetteScratch(const Projection& projection)
      : canvas(projection.width, projection.height), maker(projection) {}

  PixelCanvas canvas;
  OutlineMaker maker;
  FoldScratch folds;
};

class SilhouetteKernel {
 public:
  /// `image` has the size of the projection.
  SilhouetteKernel(const Projection& projection, std::vector<Caster> casters, const WeightImage& image);

  const Projection& projection() const { return projection_; }
  const WeightTiles& weights() const { return weights_; }

  /// Draws the silhouette of the parts that `view` shows into the canvas.
  void draw(std::span<const Instance> instances, VolumeView view, SilhouetteScratch& scratch) const;
  /// Adds up what was drawn, and clears it.
  SilhouetteCounts sweep(SilhouetteScratch& scratch) const;
  SilhouetteCounts count(std::span<const Instance> instances, VolumeView view, SilhouetteScratch& scratch) const {
    draw(instances, view, scratch);
    return sweep(scratch);
  }

 private:
  Projection projection_;
  std::vector<Caster> casters_;
  WeightTiles weights_;
};

}  // namespace espalier
