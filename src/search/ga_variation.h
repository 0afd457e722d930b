#pragma once
// Variation of the genetic algorithm: two children from two parents, mutated or crossed, and a tally of what happened.
// (ShapeGenetics 2017, Algorithm 1 lines "if rand() <= MutationProbability", Algorithm 2, section 5.)

#include <cstdint>
#include <vector>

#include "derivation/locks.h"
#include "search/engine.h"
#include "search/ga_rates.h"
#include "search/ga_settings.h"
#include "search/variation_kind.h"

namespace espalier {

/// Running totals; the order is that of `diagnostics()` and of the saved state.
struct GaCounts {
  std::uint64_t crossed_pairs = 0;
  std::uint64_t crossover_tries = 0;
  std::uint64_t failed_crossovers = 0;  // no compatible subtrees in any try: the children are copies
  std::uint64_t grown = 0, cut = 0, altered = 0, nudged = 0;
  std::uint64_t mutation_fallbacks = 0;  // the drawn kind did not exist, another did
  std::uint64_t failed_mutations = 0;    // no kind existed: the child is a copy
  std::uint64_t redrawn_children = 0;    // outside the gene limits
  std::uint64_t redrawn_twins = 0;       // equal to a member of their own generation
  std::uint64_t restarts = 0;            // populations begun anew
  std::uint64_t kept_parents = 0;        // redrawn in vain: a parent stands in
  std::uint64_t reused_scores = 0;       // individuals whose score was known, elites aside
  std::uint64_t rejected_children = 0;   // scored, found not acceptable and redrawn
  std::uint64_t rejected_starts = 0;     // the same of initial individuals
  std::uint64_t copied_starts = 0;       // redrawn in vain: a copy of an acceptable one stands in
  std::uint64_t short_starts = 0;        // initial individuals that could not grow to their length
  std::uint64_t joined_children = 0;     // children made of what several gained
  std::uint64_t joined_changes = 0;      // what was joined in these
  std::uint64_t better_joins = 0;        // of these children, those that are better than each that they were made of

  bool operator==(const GaCounts&) const = default;
};

std::vector<NamedCount> named(const GaCounts& counts);
/// Inverse of `named`; takes the values in its order.
GaCounts counts_from(const std::vector<std::uint64_t>& values);

/// A child on its way into the next generation. `scored`: it is a copy of a parent and has its score.
struct Child {
  static constexpr std::uint32_t kNone = 0xffffffff;

  Individual individual;
  bool scored = false;
  std::uint32_t parent = kNone;  // its place in the population, of the parent that it was changed from
  VariationKind kind = VariationKind::crossover;  // how it was changed
};

class GaVariation {
 public:
  /// All three must outlive it.
  GaVariation(const GeneratorGraph& graph, const Locks& locks, const GaSettings& settings)
      : graph_(graph),
        locks_(locks),
        settings_(settings),
        mutation_(settings.mutation),
        shares_{settings.grow, settings.cut, settings.alter, settings.nudge} {}

  /// Overwrites both children. They may lie outside the gene limits. Reuses the children's storage.
  void vary(const Individual& parent1, const Individual& parent2, RandomStream& random, Child& child1, Child& child2,
            GaCounts& counts) const;
  /// From now on children are made at these rates.
  void set_rates(const VariationRates& rates);

 private:
  void mutate(const Individual& parent, RandomStream& random, Child& child, GaCounts& counts) const;
  VariationKind draw_kind(RandomStream& random) const;
  double share(VariationKind kind) const { return shares_[static_cast<std::size_t>(kind)]; }
  bool apply(VariationKind kind, Derivation& derivation, RandomStream& random, GaCounts& counts) const;

  const GeneratorGraph& graph_;
  const Locks& locks_;
  const GaSettings& settings_;
  double mutation_;                   // chance that a pair is mutated
  std::array<double, 4> shares_;      // of grow, cut, alter and nudge among mutations; only ratios matter
};

}  // namespace espalier
