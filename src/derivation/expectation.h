#pragma once
// What a graph makes on average, and how much there is of it: computed from the graph, without drawing anything.

#include <cstdint>
#include <optional>
#include <vector>

#include "grammar/graph.h"

namespace espalier {

/// Expected number of genes of each rule in a derivation drawn from the prior: a branching process, generation by
/// generation. Limits of rules are not counted in. Nothing where the sum does not settle below 10^9 genes, or takes
/// more than 10^6 steps.
std::optional<std::vector<double>> expected_genes(const GeneratorGraph& graph);

struct DerivationCount {
  std::uint32_t levels = 0;  // of genes, the start gene's included
  double count = 0;          // infinity: 10^300 or more
};

/// How many complete derivations the graph has that are at most 1, 2, 4, .. 64 levels deep, draws not told apart;
/// limits of rules are not counted in. The list ends with 10^300 derivations, before 10^6 steps are spent, and where
/// there are no deeper ones.
std::vector<DerivationCount> count_derivations(const GeneratorGraph& graph);

}  // namespace espalier
