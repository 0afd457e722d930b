// The expected number of genes, generation by generation: a branching process whose types are rule and depths.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/growth.h"

namespace espalier {
namespace {

constexpr double kManyGenes = 1e6;
constexpr double kLeastMass = 1e-6;         // expected genes per generation below which the rest is left out
constexpr std::size_t kMostWork = 100'000;  // spawns followed; what takes longer is not judged

/// A rule, and how many genes of each counted rule are above.
using State = std::pair<std::size_t, std::vector<std::uint32_t>>;

}  // namespace

void Growth::check_size() {
  const auto& decls = context_.decls();
  const std::vector<std::string>& counted = samples_.counted();
  std::vector<double> of_rule(decls.size(), 0);
  std::map<State, double> generation;
  generation[{context_.index_of(*context_.start()), std::vector<std::uint32_t>(counted.size(), 0)}] = 1;
  double total = 0;
  std::size_t work = 0;
  for (std::uint32_t depth = 0; !generation.empty(); ++depth) {
    double mass = 0;
    std::map<State, double> next;
    for (auto& [state, genes] : generation) {
      const auto& [rule, counts] = state;
      const auto& limit = decls[rule].limit;
      const double here = limit ? std::min(genes, std::max(0.0, *limit - of_rule[rule])) : genes;
      of_rule[rule] += here;
      total += here;
      mass += here;
      const auto scope_at = [&](std::uint32_t at, const std::vector<std::uint32_t>& of) {
        return samples_.at(at, [&](const std::string& name) {
          return of[static_cast<std::size_t>(std::lower_bound(counted.begin(), counted.end(), name) - counted.begin())];
        });
      };
      const StaticScope scope = scope_at(depth, counts);
      std::vector<std::uint32_t> below = counts;
      const auto own = std::lower_bound(counted.begin(), counted.end(), decls[rule].name);
      if (own != counted.end() && *own == decls[rule].name) ++below[static_cast<std::size_t>(own - counted.begin())];
      const StaticScope scope_below = scope_at(depth + 1, below);
      for (const SpawnTerm& term : context_.spawns[rule]) {
        if (++work > kMostWork) return;
        const ast::ExprPtr& guard = decls[term.child].guard;
        const auto holds = guard ? evaluate_static(*guard, scope_below) : StaticValue::boolean(true);
        if (holds && holds->truth()) next[{term.child, below}] += here * mean_children(term, scope);
      }
    }
    if (total > kManyGenes) break;
    if (mass < kLeastMass) return;
    generation = std::move(next);
  }
  if (total <= kManyGenes) return;
  const auto most = static_cast<std::size_t>(std::max_element(of_rule.begin(), of_rule.end()) - of_rule.begin());
  context_.diagnostics.warning("W0803", decls[most].name_span,
                               fmt::format("derivations are expected to have more than 10^6 genes, most of them `{}`",
                                           decls[most].name),
                               "sampling stops at its budget; lower the probabilities or the depth of the guard");
}

}  // namespace espalier
