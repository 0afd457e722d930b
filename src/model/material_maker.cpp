#include "model/material_maker.h"

#include "base/hash.h"
#include "model/machine.h"

namespace espalier {

std::uint16_t MaterialMaker::number(std::uint16_t recipe, std::uint64_t steps, Model& model) {
  std::size_t at = key_below(steps, recipe) % kPlaces;
  for (;; at = (at + 1) % kPlaces) {
    Place& place = places_[at];
    if (place.model_number != model_number_) break;
    if (place.steps == steps && place.recipe == recipe) return place.material;
  }
  if (model.materials.size() >= Model::kMostMaterials) {
    ++model.plain_paints;
    return graph_.recipes[recipe].middle;
  }
  const auto material = static_cast<std::uint16_t>(graph_.materials.size() + model.materials.size());
  model.materials.push_back({steps, recipe});
  places_[at] = {steps, model_number_, recipe, material};
  return material;
}

void Machine::make_material(const Program& program, const Op& op) {
  const PaintSite& site = program.paints[op.a];
  const MaterialRecipe& recipe = graph_.recipes[site.recipe];
  if (!materials_wanted) {
    registers_[op.dst] = static_cast<float>(recipe.middle);
    return;
  }
  std::uint64_t steps = 0;
  for (std::size_t i = 0; i < site.args.size(); ++i) {
    const int step = recipe.slots[i].step_of(value(site.args[i]));
    steps = steps * (MaterialRecipe::kSteps + 1) + static_cast<std::uint64_t>(step);
  }
  registers_[op.dst] = static_cast<float>(materials->number(site.recipe, steps, *model));
}

}  // namespace espalier
