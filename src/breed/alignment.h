#pragma once
// Alignment: which genes of two derivations stand in the same place and are of the same rule and variant.

#include <cstdint>
#include <vector>

#include "derivation/position.h"

namespace espalier {

/// A pair of genes that agree: both have these draws.
struct AlignedGene {
  GenePosition first, second;
  std::uint32_t draws = 0;          // of each gene itself
  const Rule* rule = nullptr;
  const Variant* variant = nullptr;
};

/// From the start genes down, as far as rule and variant agree; parents before children. Linear time.
std::vector<AlignedGene> align(const GeneratorGraph& graph, const Derivation& first, const Derivation& second);

}  // namespace espalier
