#include "run/outcome_pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"
#include "base/counted.h"
#include "run/curve_view.h"
#include "run/output_look.h"
#include "run/silhouette_view.h"

namespace espalier {
namespace {

std::string name_of(const Setup& setup, const char* kind, std::size_t index) {
  return setup.silhouettes.size() == 1 ? fmt::format("{}.png", kind) : fmt::format("{}-{:02}.png", kind, index + 1);
}

OutcomePicture view_outcome(const Outcome& outcome, std::size_t index, const OutcomeLook& look, Executor& executor) {
  const Setup& setup = outcome.setup;
  auto room = look.view;
  if (setup.silhouettes.size() > kManySilhouettes) room = {std::max(1u, room[0] / 2), std::max(1u, room[1] / 2)};
  const bool shadow = setup.scene.silhouettes[index].shadow.has_value();
  return {OutcomeKind::view,
          fmt::format("{}, {}", setup.silhouettes[index]->name(),
                      shadow ? "the shadow on its plane; amber: wanted" : "from its camera"),
          silhouette_view(setup, index, outcome.model, outcome.surfaces, room, look.view_samples, executor), {}};
}

OutcomePicture silhouette_outcome(const SilhouetteTarget& target, const Model& model, const OutcomeLook& look) {
  const MarkedPixels marked = mark_silhouette(target, model.instances);
  return {OutcomeKind::silhouette, fmt::format("{}, {} x {} pixels", target.name(), marked.width, marked.height),
          draw_marks(marked, look.silhouette), legend_of(marked)};
}

OutcomePicture volume_outcome(const VolumeTarget& target, const Model& model, const OutcomeLook& look,
                              Executor& executor) {
  const MarkedVoxels marked = mark_voxels(target, model.instances);
  const auto scratch = target.make_scratch();
  const std::uint64_t beyond = target.counts(model.instances, *scratch).outside;
  return {OutcomeKind::volume,
          fmt::format("{}, {} x {} x {} voxels", target.name(), marked.cells[0], marked.cells[1], marked.cells[2]),
          draw_voxels(marked, look.volume, look.volume_samples, executor), legend_of(marked, beyond)};
}

OutcomePicture curves_outcome(const Outcome& outcome, const OutcomeLook& look, Executor& executor) {
  const CurveTarget& target = *outcome.setup.curves;
  RenderSettings settings = look_of(outcome.setup.scene.output);
  settings.width = look.view[0], settings.height = look.view[1], settings.samples = look.view_samples;
  const MarkedCurves marked = mark_curves(target, outcome.model);
  return {OutcomeKind::curves, fmt::format("curves, {}", counted(outcome.model.bones.size(), "bone")),
          curve_view(outcome.setup, outcome.model, outcome.surfaces, settings, executor),
          legend_of(marked, target.cost().settings())};
}

}  // namespace

std::vector<std::string> outcome_names(const Setup& setup) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < setup.silhouettes.size(); ++i) {
    names.push_back(name_of(setup, "view", i));
    names.push_back(name_of(setup, "silhouette", i));
  }
  if (setup.volume) names.emplace_back(kVolumeOverlayName);
  if (setup.curves) names.emplace_back(kCurvesName);
  return names;
}

OutcomePicture draw_outcome(const Outcome& outcome, const std::string& name, const OutcomeLook& look,
                            Executor& executor) {
  const Setup& setup = outcome.setup;
  if (setup.volume && name == kVolumeOverlayName) return volume_outcome(*setup.volume, outcome.model, look, executor);
  if (setup.curves && name == kCurvesName) return curves_outcome(outcome, look, executor);
  for (std::size_t i = 0; i < setup.silhouettes.size(); ++i) {
    if (name == name_of(setup, "view", i)) return view_outcome(outcome, i, look, executor);
    if (name == name_of(setup, "silhouette", i))
      return silhouette_outcome(*setup.silhouettes[i], outcome.model, look);
  }
  CHECK(false);
  return {};
}

Picture with_words(const OutcomePicture& drawn) {
  return drawn.legend.empty() ? drawn.picture : with_legend(drawn.picture, drawn.caption, drawn.legend);
}

}  // namespace espalier
