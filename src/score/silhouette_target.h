#pragma once
// The silhouette target: what a model covers in an image, weighed by what a drawing wants there: from a camera, or as a
// shadow. (ShapeGenetics 2017, section 8.)

#include <memory>
#include <string>

#include "model/model.h"
#include "score/silhouette_kernel.h"
#include "score/target.h"
#include "score/volume_view.h"

namespace espalier {

// wanted, free: sums of the degrees (0..1) of covered pixels that are wanted, or to be left free; T = all that is
// wanted, or where nothing is, all that is to be left free. S = smootherstep from 0.
enum class SilhouetteForm : std::uint8_t {
  linear,        // want * wanted - avoid * free                     (2017, section 8): in pixels
  smootherstep,  // want * S(wanted / T) - avoid * S(free / T)       (the published program)
};

struct SilhouetteSettings {
  std::string name = "silhouette";
  Projection projection;
  WeightImage image;  // of the projection's size
  SilhouetteForm form = SilhouetteForm::linear;
  VolumeView view = VolumeView::full;
  double want = 1, avoid = 1;  // >= 0
};

/// Immutable once made; shared by threads, each with a scratch from make_scratch().
class SilhouetteTarget final : public Target {
 public:
  /// Keeps what it needs of `meshes` (the parts that models are made of). Throws Error on weights that are not finite
  /// or below 0, an image of another size than the projection's, or one in which no pixel matters.
  SilhouetteTarget(SilhouetteSettings settings, const MeshTable& meshes);
  ~SilhouetteTarget() override;

  const SilhouetteSettings& settings() const { return settings_; }
  SilhouetteCounts counts(std::span<const Instance> instances, TargetScratch& scratch) const;
  /// The pixels that a model covers.
  PixelCanvas silhouette(std::span<const Instance> instances) const;
  double evaluate(const SilhouetteCounts& counts) const;

  const std::string& name() const override { return settings_.name; }
  TargetView view() const override {
    return settings_.view == VolumeView::full ? TargetView::full : TargetView::parts;
  }
  std::unique_ptr<TargetScratch> make_scratch() const override;
  double score(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;
  /// All that is wanted covered, and nothing else.
  double optimum() const override;
  Explanation explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;

 private:
  SilhouetteSettings settings_;
  SilhouetteKernel kernel_;
};

}  // namespace espalier
