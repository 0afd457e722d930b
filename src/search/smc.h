#pragma once
// Sequential Monte Carlo over derivations that grow (Ritchie et al. 2015; ShapeGenetics 2017, section 7). A sweep
// begins with particles of one gene each. A step grows every particle by the prior until it shows something new, in
// the order of the text (SMC) or at random open slots (SOSMC), scores it, and multiplies its weight by what its score
// rose. Particles are resampled where few carry most of the weight. When all are finished, they follow
//
//     prior(derivation) * exp(score / temperature), restricted to what is acceptable (or * score^(1 / temperature)),
//
// weighted, and the product of mean weights is an unbiased estimate of its integral (unless `most_steps` cut some
// short).
// Then another sweep begins.
//
// What growth cannot mend weighs nothing: more genes than the limits allow, and what the scorer finds not acceptable.
// Unfinished particles are scored as they stand: open slots show their `otherwise`. Where there are founders, sweeps
// begin with them instead of one gene, and the rest of the distribution is what grows from there.

#include <cstdint>
#include <vector>

#include "search/best_first.h"
#include "search/engine.h"
#include "search/gauges.h"
#include "search/smc_settings.h"

namespace espalier {

/// Running totals; the order is that of `diagnostics()` and of the saved state.
struct SmcCounts {
  std::uint64_t sweeps = 0;              // ended
  std::uint64_t failed_sweeps = 0;       // of these: no particle was left
  std::uint64_t resamplings = 0;
  std::uint64_t finished_particles = 0;  // at the ends of sweeps
  std::uint64_t closed_particles = 0;    // the same, cut short by `most_steps`
  std::uint64_t stuck_particles = 0;     // against a limit of the grammar
  std::uint64_t oversized_particles = 0, undersized_particles = 0;
  std::uint64_t rejected_particles = 0;  // not acceptable
  std::uint64_t rejected_starts = 0;     // of the first individual

  bool operator==(const SmcCounts&) const = default;
};

class SmcEngine final : public Engine {
 public:
  /// Throws Error for bad settings.
  SmcEngine(const SearchProblem& problem, const SmcSettings& settings);
  SmcEngine(const SmcEngine&) = delete;
  SmcEngine& operator=(const SmcEngine&) = delete;

  /// The first throws Error as the genetic algorithm does, where no acceptable individual can be made.
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluations_; }
  /// The particles that weigh anything, unfinished ones too; the best ever where there are none.
  std::span<const Individual> population() const override;
  /// Finished always: of unfinished particles, a closed copy is scored.
  const Individual& best() const override;
  std::vector<NamedCount> diagnostics() const override;
  std::vector<NamedGauge> gauges() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  /// 1 / temperature, as it is used.
  double beta() const { return beta_; }
  /// log weights of population(), not normalised.
  std::span<const double> log_weights() const { return std::span(log_weights_).first(living_); }
  /// Sweeps that have ended.
  std::uint64_t sweeps() const { return counts_.sweeps; }
  /// The sweep has ended: the next step begins another.
  bool sweep_is_over() const { return sweep_step_ == 0; }
  /// Of the sweep so far: log of the unbiased estimate of the integral above; -infinity where no particle is left.
  double log_evidence() const { return log_evidence_; }
  /// Of the weights before the last resampling test, 1..particles.
  double effective_particles() const { return effective_; }

 private:
  void make_first_individuals();
  Derivation begin_particle(std::size_t particle, RandomStream& random) const;
  void begin_sweep();
  void grow_particles();
  void close_particles();
  void admit(std::size_t particle);
  void score_grown();
  double increment(double before, double after) const;
  void bury(std::size_t particle);
  void sort_particles();
  void resample_particles();
  void end_sweep();
  void remember_best();
  void consider_closed(const Individual& unfinished);

  SearchProblem problem_;
  SmcSettings settings_;
  double beta_ = 1;
  std::uint64_t steps_ = 0, evaluations_ = 0;
  std::uint64_t sweep_step_ = 0;  // of the sweep that goes on; 0: none does
  std::uint32_t particle_count_ = 0;  // of this sweep
  double log_evidence_ = 0;
  double log_mean_ = 0;           // product of the mean weights at the resamplings of this sweep
  double effective_ = 0;
  double last_log_evidence_ = kNothingToTell;  // of the last sweep that ended; where none was left, nothing
  SmcCounts counts_;
  Individual best_;

  // The living come first, best first; the dead weigh nothing and wait to be resampled away.
  std::vector<Individual> particles_;
  std::vector<double> log_weights_;
  std::size_t living_ = 0;

  std::vector<std::size_t> grown_;  // particles to score
  std::vector<const Derivation*> batch_;
  std::vector<double> scores_, weights_;
  std::vector<std::uint32_t> ancestors_;
  BestFirst best_first_;
  std::vector<Individual> scratch_;
  std::vector<double> log_scratch_;
};

}  // namespace espalier
