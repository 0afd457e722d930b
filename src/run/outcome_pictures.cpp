#include "run/outcome_pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"

namespace espalier {
namespace {

OutcomePicture silhouette_outcome(const SilhouetteTarget& target, const Model& model, const OutcomeLook& look) {
  const MarkedPixels marked = mark_silhouette(target, model.instances);
  return {fmt::format("{}, {} x {} pixels", target.name(), marked.width, marked.height),
          draw_marks(marked, look.silhouette), legend_of(marked)};
}

OutcomePicture volume_outcome(const VolumeTarget& target, const Model& model, const OutcomeLook& look,
                              Executor& executor) {
  const MarkedVoxels marked = mark_voxels(target, model.instances);
  const auto scratch = target.make_scratch();
  const std::uint64_t beyond = target.counts(model.instances, *scratch).outside;
  return {fmt::format("{}, {} x {} x {} voxels", target.name(), marked.cells[0], marked.cells[1], marked.cells[2]),
          draw_voxels(marked, look.volume, look.samples, executor), legend_of(marked, beyond)};
}

}  // namespace

std::string silhouette_overlay_name(const Setup& setup, std::size_t index) {
  return setup.silhouettes.size() == 1 ? "silhouette.png" : fmt::format("silhouette-{:02}.png", index + 1);
}

std::vector<std::string> outcome_names(const Setup& setup) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < setup.silhouettes.size(); ++i) names.push_back(silhouette_overlay_name(setup, i));
  if (setup.volume) names.emplace_back(kVolumeOverlayName);
  return names;
}

OutcomePicture draw_outcome(const Setup& setup, const Model& model, const std::string& name, const OutcomeLook& look,
                            Executor& executor) {
  if (setup.volume && name == kVolumeOverlayName) return volume_outcome(*setup.volume, model, look, executor);
  for (std::size_t i = 0; i < setup.silhouettes.size(); ++i) {
    if (name == silhouette_overlay_name(setup, i)) return silhouette_outcome(*setup.silhouettes[i], model, look);
  }
  CHECK(false);
  return {};
}

Picture with_words(const OutcomePicture& outcome) {
  return with_legend(outcome.picture, outcome.title, outcome.legend);
}

}  // namespace espalier
