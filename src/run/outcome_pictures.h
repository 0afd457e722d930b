#pragma once
// Outcome pictures: what a run's best does with its targets, drawn: an overlay per silhouette, one of the volume.

#include <string>
#include <vector>

#include "base/executor.h"
#include "run/overlays.h"
#include "run/setup.h"

namespace espalier {

/// A picture of a run folder.
struct OutcomePicture {
  std::string title;
  Picture picture;
  std::vector<LegendRow> legend;
};

/// How large, in pixels across, and how fine the volume's view is.
struct OutcomeLook {
  std::uint32_t silhouette = kOverlayAcross, volume = 1400, samples = 2;
};

/// "silhouette.png", or of several "silhouette-01.png"; `index` from 0.
std::string silhouette_overlay_name(const Setup& setup, std::size_t index);
inline constexpr const char* kVolumeOverlayName = "volume.png";

/// Names of all that a scene's targets give, in the order of the scene.
std::vector<std::string> outcome_names(const Setup& setup);

/// `name` is one of outcome_names(); `model` was expanded for setup.objective.view() or more.
OutcomePicture draw_outcome(const Setup& setup, const Model& model, const std::string& name, const OutcomeLook& look,
                            Executor& executor);

/// The picture with its title and legend, as it is written to a file.
Picture with_words(const OutcomePicture& outcome);

}  // namespace espalier
