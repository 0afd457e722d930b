// The expected number of genes, generation by generation: a branching process whose types are rule and depths.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/growth.h"

namespace espalier {
namespace {

constexpr double kManyGenes = 1e6;
constexpr double kLeastMass = 1e-6;         // expected genes per generation below which the rest is left out
constexpr std::size_t kMostWork = 100'000;  // spawns followed; what takes longer is not judged

using Counts = std::vector<std::uint32_t>;  // genes above, of each counted rule
/// Expected genes of one generation.
using Generation = std::map<std::pair<std::size_t, Counts>, double>;

StaticScope scope_at(const DepthSamples& samples, std::uint32_t depth, const Counts& counts) {
  const std::vector<std::string>& counted = samples.counted();
  return samples.at(depth, [&](const std::string& name) {
    return counts[static_cast<std::size_t>(std::lower_bound(counted.begin(), counted.end(), name) - counted.begin())];
  });
}

/// What the children of a gene of the rule have above.
Counts counts_below(const DepthSamples& samples, const Counts& counts, const std::string& rule) {
  const std::vector<std::string>& counted = samples.counted();
  const auto own = std::lower_bound(counted.begin(), counted.end(), rule);
  Counts below = counts;
  if (own != counted.end() && *own == rule) ++below[static_cast<std::size_t>(own - counted.begin())];
  return below;
}

}  // namespace

void GrowthCheck::check_size() {
  const auto& decls = context_.decls();
  std::vector<double> of_rule(decls.size(), 0);
  Generation generation;
  generation[{context_.index_of(*context_.start()), Counts(samples_.counted().size(), 0)}] = 1;
  double total = 0;
  std::size_t work = 0;
  for (std::uint32_t depth = 0; total <= kManyGenes; ++depth) {
    double mass = 0;
    Generation next;
    for (const auto& [state, genes] : generation) {
      const auto& [rule, counts] = state;
      const auto& limit = decls[rule].limit;
      const double here = limit ? std::min(genes, std::max(0.0, *limit - of_rule[rule])) : genes;
      of_rule[rule] += here;
      mass += here;
      const StaticScope scope = scope_at(samples_, depth, counts);
      const Counts below = counts_below(samples_, counts, decls[rule].name);
      const StaticScope scope_below = scope_at(samples_, depth + 1, below);
      for (const SpawnTerm& term : context_.spawns[rule]) {
        if (++work > kMostWork) return;
        const ast::ExprPtr& guard = decls[term.child].guard;
        const auto holds = guard ? evaluate_static(*guard, scope_below) : StaticValue::boolean(true);
        if (holds && holds->truth()) next[{term.child, below}] += here * mean_children(term, scope);
      }
    }
    if (mass < kLeastMass) return;
    total += mass;
    generation = std::move(next);
  }
  const auto most = static_cast<std::size_t>(std::max_element(of_rule.begin(), of_rule.end()) - of_rule.begin());
  context_.diagnostics.warning(
      "W0803", decls[most].name_span,
      fmt::format("derivations are expected to have more than 10^6 genes, most of them `{}`", decls[most].name),
      "sampling stops at its budget; lower the probabilities or the depth of the guard");
}

}  // namespace espalier
