#pragma once
// Adapting a derivation to other values of its grammar's attributes. Attributes do not shape the genome, but guards,
// probabilities and weights may read them: what can no longer stand is cut (language.md 36).

#include <cstdint>
#include <optional>

#include "derivation/derivation.h"

namespace espalier {

struct Adapted {
  Derivation derivation;      // valid in the graph, and equal to what came in if that was valid
  std::uint32_t cut = 0;      // genes that went, with all below them
  std::uint32_t grown = 0;    // genes that came into slots that are required now
};

/// `derivation` fits the graph but for guards, probabilities and weights (see find_fault). Slots whose guard fails
/// become absent and lose what stood there; optional slots whose guard holds again become empty, required ones are
/// grown, their draws being keyed by the detail seed. Filled slots and variants that have probability 0 now are cut at
/// the nearest optional slot above. Nothing where there is none, or where required growth has no end.
std::optional<Adapted> adapt(const GeneratorGraph& graph, const Derivation& derivation);

}  // namespace espalier
