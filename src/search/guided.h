#pragma once
// GuidedEngine: SOSMC on skeletons (Guiding curves 2018, sections 3.2 to 4.1), and on from there. Particles grow side by
// side in one pool and share what they have in common; each step grows every particle by one gene that shows something,
// weighs it by what it adds to the score and by what its open slots promise, and resamples. A skeleton may stay
// unfinished: the slots that it leaves open show their `otherwise`.
//
// When a sweep has taken all its steps, the next *round* takes back a part of the best skeleton, of all those that are
// worth less than nothing and some others, and grows it anew in the same way (a large neighbourhood search, Shaw 1998,
// with SOSMC for its repair). With `regrow` off every sweep is a textbook one from the seed, whose particles follow
// prior * exp(score / temperature) when all are finished.
//
// Founders are where the first round begins: what another search, or this one under other curves, has found.

#include <cstdint>
#include <memory>
#include <vector>

#include "derivation/growth_pool.h"
#include "search/engine.h"
#include "search/guided_settings.h"

namespace espalier {

/// Running totals; the order is that of `diagnostics()` and of the saved state.
struct GuidedCounts {
  std::uint64_t sweeps = 0;      // ended, from the seed
  std::uint64_t rounds = 0;      // ended, from the best
  std::uint64_t improved = 0;    // of these: found something better
  std::uint64_t taken_back = 0;  // steps that rounds took back
  std::uint64_t finished_particles = 0;  // at the ends of sweeps and rounds: no slot is open

  bool operator==(const GuidedCounts&) const = default;
};

class GuidedEngine final : public Engine {
 public:
  /// Throws Error for bad settings.
  GuidedEngine(const SearchProblem& problem, const GuidedSettings& settings);
  ~GuidedEngine() override;
  GuidedEngine(const GuidedEngine&) = delete;
  GuidedEngine& operator=(const GuidedEngine&) = delete;

  void step() override;
  std::uint64_t steps() const override { return steps_; }
  /// Particle-steps.
  std::uint64_t evaluations() const override { return evaluations_; }
  /// The best; and at the end of a sweep from the seed all its particles.
  std::span<const Individual> population() const override;
  /// Open slots and all.
  const Individual& best() const override;
  double best_score() const override { return best_score_; }
  double mean_score() const override { return mean_score_; }
  bool leaves_open() const override { return true; }
  std::vector<NamedCount> diagnostics() const override;
  std::vector<NamedGauge> gauges() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  /// No particle grows on: the next step begins a sweep or a round.
  bool sweep_is_over() const { return over_; }
  /// Of the particles, in order, not normalised; at the end of a sweep from the seed those of its population.
  std::span<const double> log_weights() const { return log_weights_; }
  /// At the end of a sweep from the seed: log of an unbiased estimate of the integral of prior * exp(score /
  /// temperature), where the grammar has no limits and all particles finished.
  double log_evidence() const { return log_evidence_; }

 private:
  /// What else is known of a particle.
  struct Account {
    double score = 0, promise = 0;
  };

  void pack_best() const;
  void begin_sweep();
  void begin_round();
  void take_founders();
  Derivation locked_start() const;
  void run_genes(std::size_t place, const GrowingDerivation& growing);
  void choose_cuts();
  void grow_particles();
  void score_particles();
  void weigh();
  void resample_particles();
  void end_sweep();
  void tidy_pool(std::size_t most);
  std::uint32_t particles_at(std::uint64_t step) const;
  double heuristic_at(std::uint64_t step) const;

  SearchProblem problem_;
  GuidedSettings settings_;
  std::unique_ptr<GrowthScorer> scorer_;
  GrowthPool pool_;
  std::uint64_t steps_ = 0, evaluations_ = 0;
  bool over_ = true, seeded_ = false;  // whether the sweep that goes on, or ended last, began from the seed
  std::uint64_t sweep_step_ = 0, sweep_length_ = 0;  // steps taken, and to take
  std::size_t tidy_at_ = 0;            // shoots in the pool
  double effective_ = 0, mean_score_ = 0;
  double log_mean_ = 0, log_evidence_ = 0;  // product of the mean weights at the resamplings; see log_evidence()
  GuidedCounts counts_;

  std::vector<GrowingDerivation> particles_, scratch_;
  std::vector<Account> accounts_, account_scratch_;
  std::vector<double> log_weights_, weights_, scores_, promises_;
  std::vector<std::uint32_t> ancestors_;

  // The best ever: in the pool, packed, or both.
  bool has_best_ = false, best_pooled_ = false;
  mutable bool best_packed_ = false;
  double best_score_ = 0, round_began_with_ = 0;
  GrowingDerivation best_;
  mutable Individual best_individual_;
  std::vector<Individual> population_;  // of a sweep from the seed that has just ended

  std::uint32_t pinned_ = 1;  // so many shoots of the best's history stay
  std::vector<ShootId> history_;
  std::vector<std::uint8_t> cut_;
  std::vector<double> worth_;                  // per shoot of the history, with all below it
  std::vector<std::uint32_t> sizes_, parents_;  // likewise: steps; places in the history of the genes that they stand on
  std::vector<std::uint32_t> kept_;            // places in the history
  GrowthRenumbering renumbering_;
};

}  // namespace espalier
