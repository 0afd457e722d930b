#include "studio/free_growth.h"

#include <algorithm>

#include "base/error.h"
#include "derivation/moves.h"
#include "derivation/sample.h"

namespace espalier::studio {
namespace {

constexpr std::uint32_t kMostGenes = 20'000;

}  // namespace

Derivation grow_freely(const GeneratorGraph& graph, const Scene& scene, std::uint32_t index) {
  const std::uint32_t most = std::min(scene.search.ga.genes.max, kMostGenes);
  RandomStream random({scene.seed, Purpose::sample, 0, index, 0});
  Derivation derivation = seedling(graph, random);
  if (scene.search.engine == EngineKind::guided) {
    for (std::uint32_t step = 0; step < scene.search.guided.steps && derivation.size() < most; ++step) {
      if (grow_open_slot(graph, derivation, random) != GrowthStep::grown) break;
    }
    return derivation;
  }
  if (!close_open_slots(graph, derivation, random, kMostGenes)) {
    throw Error("what the start requires cannot be grown: it has no end, or more than 20 000 genes");
  }
  const std::uint32_t wanted = std::min(most, scene.search.ga.initial_length_max);
  while (derivation.size() < wanted && grow(graph, derivation, {}, random)) {}
  return derivation;
}

}  // namespace espalier::studio
