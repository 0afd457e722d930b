#pragma once
// Outcome pictures: what a run's best does with its targets, drawn: per silhouette a view from its camera and an
// overlay, an overlay of the volume, and guiding curves over the model and its bones.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/executor.h"
#include "run/overlays.h"
#include "run/setup.h"

namespace espalier {

/// What is drawn: a model, expanded with its details.
struct Outcome {
  const Setup& setup;
  const Model& model;
  const Surfaces& surfaces;
};

enum class OutcomeKind : std::uint8_t { view, silhouette, volume, curves };

/// A picture of a run folder.
struct OutcomePicture {
  OutcomeKind kind = OutcomeKind::view;
  std::string caption;
  Picture picture;
  std::vector<LegendRow> legend;  // views have none
};

/// How large, in pixels across, and how fine; `view` and `view_samples` hold for curves too. Views of scenes with more
/// than kManySilhouettes have half of each side.
struct OutcomeLook {
  std::array<std::uint32_t, 2> view = {1200, 900};
  int view_samples = RenderSettings().samples;
  std::uint32_t silhouette = kOverlayAcross, volume = 1400, volume_samples = 2;
};

inline constexpr std::size_t kManySilhouettes = 8;
inline constexpr const char* kVolumeOverlayName = "volume.png";
inline constexpr const char* kCurvesName = "curves.png";

/// Names of all that a scene's targets give, in the order of the scene: "view.png" and "silhouette.png", or of several
/// silhouettes "view-01.png" and so on; "volume.png"; "curves.png".
std::vector<std::string> outcome_names(const Setup& setup);

/// `name` is one of outcome_names().
OutcomePicture draw_outcome(const Outcome& outcome, const std::string& name, const OutcomeLook& look,
                            Executor& executor);

/// The picture as it is written to a file: overlays with their caption and legend.
Picture with_words(const OutcomePicture& drawn);

}  // namespace espalier
