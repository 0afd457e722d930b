#pragma once
// The chances that a graph gives to slots and variants where a gene stands. Grammars may compute them from depth, so
// they are brought into range here: below 0 and NaN count as 0, above 1 as 1.

#include <optional>
#include <span>

#include "base/random.h"
#include "derivation/derivation.h"

namespace espalier {

/// The guard of the edge's child holds for a gene with `above` genes above it.
inline bool may_stand(const GeneratorGraph& graph, EdgeId edge, const DepthCounts& above) {
  const Rule& rule = graph.rule_of(edge);
  return !rule.guarded || rule.guard.at(above) != 0;
}

/// p of an optional edge at its parent gene, which has `above` genes above it; 1 for a required edge. In [0, 1].
inline double fill_probability(const Edge& edge, const DepthCounts& above) {
  if (edge.required) return 1;
  const double p = edge.probability.at(above);
  return p > 0 ? (p < 1 ? p : 1.0) : 0.0;
}

/// Probability of a variant of a gene with `above` genes above it, in [0, 1].
inline double variant_probability(const Variant& variant, const DepthCounts& above) {
  const double p = variant.probability.at(above);
  return p > 0 ? (p < 1 ? p : 1.0) : 0.0;
}

/// Picks a variant by its probability, among those with allowed[v] != 0 (empty: all). Nothing where all have 0.
/// Takes no random number where only one can be meant.
std::optional<std::uint16_t> pick_variant(const Rule& rule, const DepthCounts& above, RandomStream& random,
                                          std::span<const std::uint8_t> allowed = {});

/// Some guard, weight or probability of the graph depends on depth: what is valid at one depth need not be at another.
bool depends_on_depth(const GeneratorGraph& graph);

}  // namespace espalier
