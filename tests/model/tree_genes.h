#pragma once
// Trees whose genome is the draws of their start rule, Tree. Genes are set by name, as quantiles.

#include <algorithm>
#include <map>
#include <string>

#include "model/shipped.h"

namespace espalier::test {

using Quantiles = std::map<std::string, double>;  // 0..1

inline std::uint32_t quantile(double u) { return u >= 1 ? 0xffffffffu : static_cast<std::uint32_t>(u * 0x1p32); }

/// With details. Genes that `quantiles` does not name have the quantile `others`.
inline Model tree_of(const GeneratorGraph& graph, const Quantiles& quantiles, double others, std::uint64_t seed) {
  RandomStream random = stream_of(1);
  Derivation derivation = seedling(graph, random);
  derivation.detail_seed = seed;
  std::fill(derivation.draws.begin(), derivation.draws.end(), quantile(others));
  const auto& draws = graph.rules[0].draws;
  for (const auto& [name, u] : quantiles) {
    const auto named = [&gene = name](const DrawComponent& d) { return d.name == "Tree." + gene; };
    const auto at = std::find_if(draws.begin(), draws.end(), named);
    EXPECT_NE(at, draws.end()) << name;
    derivation.draws.at(static_cast<std::size_t>(at - draws.begin())) = quantile(u);
  }
  Model model;
  Expander(graph).expand(derivation, ExpandTo::full, model);
  return model;
}

}  // namespace espalier::test
