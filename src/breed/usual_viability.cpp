#include "breed/usual_viability.h"

#include "base/random.h"
#include "breed/newcomer.h"
#include "model/expand.h"

namespace espalier {

ViabilitySettings usual_viability(const GeneratorGraph& graph, const MeshTable& meshes) {
  ViabilitySettings settings;
  const Viability viability(meshes, settings);
  ExpandLimits limits;
  limits.most_parts = 20'000, limits.most_turns = 200'000, limits.most_copies = 100'000;
  limits.make_materials = false;
  Expander expander(graph, limits);
  Model model;
  Viability::Scratch scratch;
  std::uint32_t below = 0, crowded = 0;
  for (std::uint32_t i = 0; i < kUsualDraws; ++i) {
    RandomStream random({0, Purpose::probe, 1u << 23, i, 0});
    const Derivation derivation = draw_newcomer(graph, random);
    expander.expand(derivation, ExpandTo::full, model);
    const ViabilityReport report = viability.judge(derivation, model, scratch);
    below += report.below_ground > settings.most_below_ground;
    crowded += report.crowding > settings.most_crowding;
  }
  if (2 * below > kUsualDraws) settings.most_below_ground = 1;
  if (2 * crowded > kUsualDraws) settings.most_crowding = 1;
  return settings;
}

}  // namespace espalier
