#include "breed/newcomer.h"

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "derivation/strip.h"

namespace espalier {
namespace {

void finish(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random) {
  while (derivation.size() < kMostNewcomerGenes &&
         grow_open_slot(graph, derivation, random) == GrowthStep::grown) {}
  if (!is_finished(derivation) && !close_open_slots(graph, derivation, random)) {
    throw Error(fmt::format("grammar {}: required slots cannot be grown to an end", graph.name));
  }
}

/// Priors are often of small models with long tails; nobody wants a screen of bare trunks.
void lengthen(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks, RandomStream& random) {
  const std::uint32_t wanted = kShortestNewcomer + random.below(kLongestGrown - kShortestNewcomer + 1);
  while (derivation.size() < wanted && grow(graph, derivation, locks, random)) {}
}

}  // namespace

Derivation draw_newcomer(const GeneratorGraph& graph, RandomStream& random) {
  Derivation derivation = sample(graph, random, kMostNewcomerGenes).derivation;
  finish(graph, derivation, random);
  lengthen(graph, derivation, {}, random);
  return derivation;
}

Derivation draw_newcomer(const GeneratorGraph& graph, const Derivation& host, const Held& held, RandomStream& random) {
  if (held.genes.empty()) {
    Derivation newcomer = draw_newcomer(graph, random);
    keep_held_draws(graph, host, held, newcomer);
    return newcomer;
  }
  Derivation newcomer = stripped(graph, host, held.genes);
  reopen(graph, newcomer, held.genes);
  finish(graph, newcomer, random);
  lengthen(graph, newcomer, held.genes, random);
  const std::vector<std::uint8_t> is_held = held_draws(graph, newcomer, held);
  for (std::size_t i = 0; i < is_held.size(); ++i) {
    if (!is_held[i]) newcomer.draws[i] = random.next_u32();
  }
  return newcomer;
}

}  // namespace espalier
