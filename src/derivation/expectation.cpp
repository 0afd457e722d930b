#include "derivation/expectation.h"

#include <limits>
#include <map>

#include "derivation/chances.h"

namespace espalier {
namespace {

constexpr std::size_t kMostSteps = 1'000'000;
constexpr double kMostGenes = 1e9;
constexpr double kLeastMass = 1e-12;  // expected genes of a generation below which the rest is left out
constexpr double kMostDerivations = 1e300;
constexpr std::uint32_t kMostLevels = 64;

// A rule, and how many genes of each counted rule are above.
struct Place {
  RuleId rule = 0;
  std::vector<std::uint32_t> counts;
  auto operator<=>(const Place&) const = default;
};

std::vector<std::uint32_t> counts_below(const Rule& rule, const std::vector<std::uint32_t>& counts) {
  std::vector<std::uint32_t> below = counts;
  if (rule.counted) ++below[*rule.counted];
  return below;
}

class DerivationCounter {
 public:
  explicit DerivationCounter(const GeneratorGraph& graph) : graph_(graph) {}

  /// Of at most so many levels; nothing when out of steps.
  std::optional<double> count(std::uint32_t levels) {
    known_.clear();
    levels_ = levels;
    const Place start{graph_.start(), std::vector<std::uint32_t>(graph_.counted_rules.size(), 0)};
    const double result = below(start, 0);
    return steps_ > kMostSteps ? std::nullopt : std::optional(result);
  }

 private:
  double below(const Place& place, std::uint32_t depth) {
    if (depth >= levels_ || steps_ > kMostSteps) return 0;
    const auto [found, fresh] = known_.try_emplace({depth, place}, 0);
    if (!fresh) return found->second;
    const Rule& rule = graph_.rules[place.rule];
    const std::vector<std::uint32_t> counts = counts_below(rule, place.counts);
    double sum = 0;
    for (const Variant& variant : rule.variants) {
      if (variant_probability(variant, {depth, place.counts}) == 0) continue;
      double ways = 1;
      for (const std::uint16_t slot : variant.slots) {
        ++steps_;
        const EdgeId edge = rule.slots[slot].edge;
        if (!may_stand(graph_, edge, {depth + 1, counts})) continue;
        const double p = fill_probability(graph_.edges[edge], {depth, place.counts});
        const double filled = p > 0 ? below({graph_.edges[edge].child, counts}, depth + 1) : 0;
        ways *= filled + (p < 1 ? 1 : 0);
      }
      sum += ways;
    }
    known_[{depth, place}] = sum;
    return sum;
  }

  const GeneratorGraph& graph_;
  std::uint32_t levels_ = 0;
  std::size_t steps_ = 0;
  std::map<std::pair<std::uint32_t, Place>, double> known_;
};

}  // namespace

std::optional<std::vector<double>> expected_genes(const GeneratorGraph& graph) {
  std::vector<double> expected(graph.rules.size(), 0);
  std::map<Place, double> generation, next;
  generation[{graph.start(), std::vector<std::uint32_t>(graph.counted_rules.size(), 0)}] = 1;
  double total = 0;
  std::size_t steps = 0;
  for (std::uint32_t depth = 0; !generation.empty(); ++depth) {
    next.clear();
    double mass = 0;
    for (const auto& [place, genes] : generation) {
      const Rule& rule = graph.rules[place.rule];
      expected[place.rule] += genes;
      mass += genes;
      const std::vector<std::uint32_t> counts = counts_below(rule, place.counts);
      for (const Variant& variant : rule.variants) {
        const double chosen = genes * variant_probability(variant, {depth, place.counts});
        for (const std::uint16_t slot : variant.slots) {
          if (++steps > kMostSteps) return std::nullopt;
          const EdgeId edge = rule.slots[slot].edge;
          if (chosen == 0 || !may_stand(graph, edge, {depth + 1, counts})) continue;
          const double filled = chosen * fill_probability(graph.edges[edge], {depth, place.counts});
          if (filled > 0) next[{graph.edges[edge].child, counts}] += filled;
        }
      }
    }
    total += mass;
    if (!(total <= kMostGenes)) return std::nullopt;
    if (mass < kLeastMass) break;
    generation.swap(next);
  }
  return expected;
}

std::vector<DerivationCount> count_derivations(const GeneratorGraph& graph) {
  std::vector<DerivationCount> counts;
  DerivationCounter counter(graph);
  double last = -1;
  for (std::uint32_t levels = 1; levels <= kMostLevels; levels *= 2) {
    const std::optional<double> count = counter.count(levels);
    if (!count || (*count == last && last > 0)) break;
    last = *count;
    const bool many = !(last < kMostDerivations);
    counts.push_back({levels, many ? std::numeric_limits<double>::infinity() : last});
    if (many) break;
  }
  return counts;
}

}  // namespace espalier
