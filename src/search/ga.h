#pragma once
// The genetic algorithm (ShapeGenetics 2017, Algorithms 1 and 2, section 6; Haubenwallner et al. 2016, section 3).
// A step makes a generation: the best `elitism` individuals unchanged, then pairs of children of selected parents.
//
// Beyond the papers, `join` makes one more child per parent: children that became better each in a place of its own are
// put together (derivation/join.h). A large model improves in many places in one generation, where crossover rarely
// brings two of them together.
//
// Cost per step: population - elitism evaluations (the first: population), and one more for each individual that the
// scorer finds not acceptable: it is redrawn; with `join` one for each joined child. An individual that did not change
// keeps its score. No individual of any population is beyond the gene limits or not acceptable.

#include <unordered_set>
#include <vector>

#include "derivation/join.h"
#include "search/best_first.h"
#include "search/engine.h"
#include "search/ga_gains.h"
#include "search/ga_settings.h"
#include "search/ga_variation.h"
#include "search/initial_population.h"
#include "search/selection.h"

namespace espalier {

class GaEngine final : public Engine {
 public:
  /// Throws Error for bad settings.
  GaEngine(const SearchProblem& problem, const GaSettings& settings);
  GaEngine(const GaEngine&) = delete;
  GaEngine& operator=(const GaEngine&) = delete;

  /// The first throws Error when the graph yields no derivation within the gene limits, or none that is acceptable in
  /// kMostStartRounds * population tries.
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluations_; }
  std::span<const Individual> population() const override { return population_; }
  const Individual& best() const override;
  std::vector<NamedCount> diagnostics() const override { return named(counts_); }
  std::vector<NamedGauge> gauges() const override;

  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

 private:
  /// With restarts, every kReunion-th population starts with the best of those since the last such.
  static constexpr std::uint32_t kReunion = 4;

  /// A pair of places in the next generation, and the streams that its children are drawn with.
  struct Brood {
    RandomStream choosing, varying;
    std::uint32_t attempts = 0;
  };

  void begin_population();
  bool restart_is_due() const;
  void make_next_generation();
  void redraw_children();
  void breed(Brood& brood, std::span<const std::size_t> places);
  void admit(Child& child, std::size_t place);
  void tally(std::size_t place, double score);
  void remember_population();
  bool find_known(Individual& individual) const;
  void score_newcomers();
  void join_gains();
  void join_of(std::span<const std::size_t> places);
  void take_changes(std::span<const std::size_t> places);
  void sort_newcomers();

  SearchProblem problem_;
  GaSettings settings_;
  GaVariation variation_;
  Selection first_, second_;
  std::uint64_t steps_ = 0;
  std::uint64_t evaluations_ = 0;
  GaCounts counts_;
  GaGains gains_;
  std::uint32_t epoch_ = 0;     // populations begun so far, less one
  std::uint64_t stalled_ = 0;   // generations since the best of this population last rose
  std::vector<Individual> champions_;  // the best of the populations since the last reunion
  Individual best_;

  // Two populations change places every generation, so once warm nothing is allocated.
  std::vector<Individual> population_;  // sorted, best first
  std::vector<Individual> newcomers_;   // the generation being made, in order of birth
  std::vector<char> scored_;            // per newcomer
  std::vector<std::uint32_t> parents_;  // per newcomer: the place of its parent in population_, or Child::kNone
  std::vector<VariationKind> kinds_;    // per newcomer that has a parent
  std::vector<std::size_t> gainers_;    // join only: places of newcomers that are better than their parents
  std::vector<Change> changes_;         // join only: of one parent's children, pairwise apart
  std::vector<std::size_t> rejected_;   // places of newcomers that were just found not acceptable, ascending
  std::vector<Brood> broods_;           // of the generation being made
  Child children_[2];
  std::vector<double> scores_;
  std::vector<const Derivation*> batch_;
  std::vector<std::size_t> batch_places_;
  BestFirst best_first_;
  struct Known {
    std::uint64_t hash;
    std::size_t index;
  };
  std::unordered_set<std::uint64_t> born_;  // unique only: hashes of the generation being made
  std::vector<Known> known_;  // reuse_scores only: the population by hash
};

}  // namespace espalier
