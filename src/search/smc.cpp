#include "search/smc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/natural_log.h"
#include "derivation/strip.h"
#include "search/initial_population.h"
#include "search/require.h"

namespace espalier {
SmcEngine::SmcEngine(const SearchProblem& problem, const SmcSettings& settings)
    : problem_(problem), settings_(validated(settings)) {
  CHECK(problem_.scorer != nullptr);
  beta_ = inverse_temperature(settings_.weight, settings_.temperature, problem_.scorer->optimum(), 200);
  particle_count_ = settings_.particles;
}

const Individual& SmcEngine::best() const {
  CHECK(steps_ > 0);
  return best_;
}

std::span<const Individual> SmcEngine::population() const {
  if (living_ > 0) return std::span(particles_).first(living_);
  return steps_ > 0 ? std::span(&best_, 1) : std::span<const Individual>();
}

void SmcEngine::step() {
  if (steps_ == 0) make_first_individuals();
  if (sweep_step_ == 0) {
    begin_sweep();
  } else if (sweep_step_ > settings_.most_steps) {
    close_particles();
  } else {
    grow_particles();
  }
  ++sweep_step_;
  score_grown();
  sort_particles();
  remember_best();
  log_evidence_ = log_mean_ + log_sum(log_weights_) - natural_log(particle_count_);
  const bool over = std::all_of(particles_.begin(), particles_.begin() + static_cast<std::ptrdiff_t>(living_),
                                [](const Individual& particle) { return is_finished(particle.derivation); });
  if (over) {
    end_sweep();
  } else {
    resample_particles();
  }
  ++steps_;
}

void SmcEngine::make_first_individuals() {
  // Several, so that hard limits which few models meet are met by one.
  constexpr std::uint32_t kMostFirst = 100;
  const StartSettings settings = {std::min(settings_.particles, kMostFirst), settings_.initial_length_min,
                                  settings_.initial_length_max, settings_.genes};
  StartResult made = make_initial_population(problem_, settings, 0, problem_.founders, {});
  best_ = *std::max_element(made.individuals.begin(), made.individuals.end(),
                            [](const Individual& a, const Individual& b) { return a.score < b.score; });
  evaluations_ += made.evaluations;
  counts_.rejected_starts += made.rejected_starts;
}

/// Of founders, what is empty grows on; where there are locks, optional slots that these do not hold are emptied first.
Derivation SmcEngine::begin_particle(std::size_t particle, RandomStream& random) const {
  if (problem_.founders.empty()) return seedling(*problem_.graph, random);
  Derivation start = problem_.founders[particle % problem_.founders.size()].derivation;
  if (!problem_.locks.empty()) start = stripped(*problem_.graph, start, problem_.locks);
  reopen(*problem_.graph, start, problem_.locks);
  return start;
}

void SmcEngine::begin_sweep() {
  particles_.resize(particle_count_);
  log_weights_.assign(particle_count_, 0);
  living_ = particle_count_;
  log_mean_ = 0;
  grown_.clear();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    RandomStream random({problem_.seed, Purpose::initial, problem_.lane, static_cast<std::uint32_t>(i + 1),
                         static_cast<std::uint32_t>(steps_)});
    particles_[i].derivation = begin_particle(i, random);
    // As if it had weighed 1 before: its first weight is that of its score.
    particles_[i].score = settings_.weight == ScoreWeight::ratio ? 1 : 0;
    admit(i);
  }
}

void SmcEngine::grow_particles() {
  grown_.clear();
  for (std::size_t i = 0; i < living_; ++i) {
    Derivation& derivation = particles_[i].derivation;
    if (is_finished(derivation)) continue;
    RandomStream random({problem_.seed, Purpose::vary, problem_.lane, static_cast<std::uint32_t>(i),
                         static_cast<std::uint32_t>(steps_)});
    if (grow_open_slot(*problem_.graph, derivation, random, settings_.order, true) == GrowthStep::stuck) {
      ++counts_.stuck_particles;
      bury(i);
    } else {
      admit(i);
    }
  }
}

void SmcEngine::close_particles() {
  grown_.clear();
  for (std::size_t i = 0; i < living_; ++i) {
    Derivation& derivation = particles_[i].derivation;
    if (is_finished(derivation)) continue;
    RandomStream random({problem_.seed, Purpose::close, problem_.lane, static_cast<std::uint32_t>(i),
                         static_cast<std::uint32_t>(steps_)});
    ++counts_.closed_particles;
    if (close_open_slots(*problem_.graph, derivation, random, settings_.genes.max)) {
      admit(i);
    } else {
      ++counts_.stuck_particles;
      bury(i);
    }
  }
}

/// To be scored, unless its genes are too many, or too few for good.
void SmcEngine::admit(std::size_t particle) {
  const Derivation& derivation = particles_[particle].derivation;
  if (derivation.size() > settings_.genes.max) {
    ++counts_.oversized_particles;
    bury(particle);
  } else if (derivation.size() < settings_.genes.min && is_finished(derivation)) {
    ++counts_.undersized_particles;
    bury(particle);
  } else {
    grown_.push_back(particle);
  }
}

/// The dead keep their place until the particles are sorted.
void SmcEngine::bury(std::size_t particle) {
  particles_[particle].score = kNotAcceptable;
  log_weights_[particle] = -std::numeric_limits<double>::infinity();
}

double SmcEngine::increment(double before, double after) const {
  return beta_ * (log_weight(settings_.weight, after) - log_weight(settings_.weight, before));
}

void SmcEngine::score_grown() {
  batch_.clear();
  for (const std::size_t i : grown_) batch_.push_back(&particles_[i].derivation);
  scores_.resize(batch_.size());
  if (!batch_.empty()) problem_.scorer->score(batch_, scores_);
  evaluations_ += batch_.size();
  for (std::size_t k = 0; k < grown_.size(); ++k) {
    const std::size_t i = grown_[k];
    if (scores_[k] == kNotAcceptable) {
      ++counts_.rejected_particles;
      bury(i);
      continue;
    }
    CHECK(std::isfinite(scores_[k]));
    log_weights_[i] += increment(particles_[i].score, scores_[k]);
    particles_[i].score = scores_[k];
  }
}

void SmcEngine::sort_particles() {
  best_first_.sort(particles_);
  best_first_.follow(log_weights_, log_scratch_);
  while (living_ > 0 && particles_[living_ - 1].score == kNotAcceptable) --living_;
}

void SmcEngine::remember_best() {
  for (std::size_t i = 0; i < living_ && particles_[i].score > best_.score; ++i) {
    if (is_finished(particles_[i].derivation)) {
      best_ = particles_[i];
      return;
    }
    if (i == 0) consider_closed(particles_[i]);
  }
}

void SmcEngine::consider_closed(const Individual& unfinished) {
  Derivation closed = unfinished.derivation;
  RandomStream random({problem_.seed, Purpose::close, problem_.lane, 0xffffffff, static_cast<std::uint32_t>(steps_)});
  if (!close_open_slots(*problem_.graph, closed, random, settings_.genes.max)) return;
  if (closed.size() < settings_.genes.min || closed.size() > settings_.genes.max) return;
  const Derivation* one[] = {&closed};
  double score[1];
  problem_.scorer->score(one, score);
  ++evaluations_;
  if (score[0] > best_.score) best_ = {std::move(closed), score[0]};
}

void SmcEngine::resample_particles() {
  normalise(log_weights_, weights_);  // some particle lives: the sweep is not over
  effective_ = effective_size(weights_);
  if (settings_.resample_below < 1 && effective_ >= settings_.resample_below * particle_count_) return;
  log_mean_ += log_sum(log_weights_) - natural_log(particle_count_);
  RandomStream random({problem_.seed, Purpose::resample, problem_.lane, 0, static_cast<std::uint32_t>(steps_)});
  resample(settings_.resampling, weights_, particle_count_, random, ancestors_);
  scratch_.resize(particles_.size());
  for (std::size_t i = 0; i < ancestors_.size(); ++i) scratch_[i] = particles_[ancestors_[i]];
  particles_.swap(scratch_);
  log_weights_.assign(particle_count_, 0);
  living_ = particle_count_;
  ++counts_.resamplings;
}

void SmcEngine::end_sweep() {
  sweep_step_ = 0;
  ++counts_.sweeps;
  counts_.failed_sweeps += living_ == 0;
  counts_.finished_particles += living_;
  if (living_ > 0) {
    normalise(log_weights_, weights_);
    effective_ = effective_size(weights_);
  }
  last_log_evidence_ = living_ > 0 ? log_evidence_ : kNothingToTell;
  const double next = std::ceil(particle_count_ * settings_.schedule);
  particle_count_ = static_cast<std::uint32_t>(
      std::min<double>(std::max(settings_.most_particles, settings_.particles), next));
}

}  // namespace espalier
