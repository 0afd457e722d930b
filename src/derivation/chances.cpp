#include "derivation/chances.h"

#include <algorithm>

namespace espalier {

std::optional<std::uint16_t> pick_variant(const Rule& rule, const DepthCounts& above, RandomStream& random,
                                          std::span<const std::uint8_t> allowed) {
  const auto chance_of = [&](std::size_t v) {
    return allowed.empty() || allowed[v] ? variant_probability(rule.variants[v], above) : 0.0;
  };
  if (rule.variants.size() == 1) return chance_of(0) > 0 ? std::optional<std::uint16_t>(0) : std::nullopt;
  double total = 0;
  for (std::size_t v = 0; v < rule.variants.size(); ++v) total += chance_of(v);
  if (!(total > 0)) return std::nullopt;
  double rest = random.next_unit() * total;
  std::optional<std::uint16_t> picked;
  for (std::size_t v = 0; v < rule.variants.size(); ++v) {
    const double p = chance_of(v);
    if (p <= 0) continue;
    picked = static_cast<std::uint16_t>(v);  // the last one, should rounding leave a rest
    if (rest < p) break;
    rest -= p;
  }
  return picked;
}

bool depends_on_depth(const GeneratorGraph& graph) {
  for (const Rule& rule : graph.rules) {
    if (rule.guarded && !rule.guard.constant()) return true;
    for (const Variant& variant : rule.variants) {
      if (!variant.probability.constant()) return true;
    }
  }
  return std::any_of(graph.edges.begin(), graph.edges.end(),
                     [](const Edge& edge) { return !edge.required && !edge.probability.constant(); });
}

}  // namespace espalier
