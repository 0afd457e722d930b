#pragma once
// Genesis (Grefenstette 1990), the genetic algorithm that bred GenTree's trees (Congdon and Mazza 2003), as an engine:
// bit strings, stochastic universal sampling, two-point crossover, mutation that draws bits anew, a generation gap,
// fitness above the worst of a scaling window or by rank, and an elite. For grammars whose genome is the draws of the
// start rule alone.
//
// Cost per step: one evaluation for each string that is not as its parent was, the first: population. A child that the
// scorer does not accept is replaced by its parent. Where `idle` generations brought nothing to score (Genesis would
// end there), a new population begins, with the best of the last one if there is elitism.

#include <vector>

#include "search/engine.h"
#include "search/genesis_strings.h"

namespace espalier {

/// Running totals; the order is that of `diagnostics()` and of the saved state.
struct GenesisCounts {
  std::uint64_t crossed = 0, mutated = 0;   // children that were scored; crossed ones may be mutated too
  std::uint64_t copied = 0;                 // children that are as their parent was
  std::uint64_t rejected = 0;               // children found not acceptable
  std::uint64_t rejected_starts = 0;
  std::uint64_t populations = 0;            // begun

  bool operator==(const GenesisCounts&) const = default;
};

class GenesisEngine final : public Engine {
 public:
  /// Throws Error for bad settings, for a grammar whose genome is more than draws of its start rule, and where a lock
  /// holds the start gene's draws, as then nothing is left to search.
  GenesisEngine(const SearchProblem& problem, const GenesisSettings& settings);
  GenesisEngine(const GenesisEngine&) = delete;
  GenesisEngine& operator=(const GenesisEngine&) = delete;

  /// The first throws Error where no acceptable string is found in kMostStartRounds * population tries.
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluations_; }
  std::span<const Individual> population() const override { return population_; }
  const Individual& best() const override;
  std::vector<NamedCount> diagnostics() const override;
  /// "alleles lost": share of the bits that are the same in the whole population; crossover cannot bring them back.
  std::vector<NamedGauge> gauges() const override;

  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

 private:
  void begin_population();
  void make_next_generation();
  void score_missing(std::span<const std::size_t> places);
  void settle();

  SearchProblem problem_;
  GenesisSettings settings_;
  GenesisEncoding encoding_;
  std::uint64_t steps_ = 0, evaluations_ = 0;
  GenesisCounts counts_;
  std::uint32_t idle_ = 0;  // generations in a row without an evaluation
  ScalingWindow window_;
  Individual best_;
  std::vector<Individual> population_;  // best first, equal ones in order of birth
  std::vector<Individual> newcomers_;
};

}  // namespace espalier
