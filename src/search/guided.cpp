#include "search/guided.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/check.h"
#include "base/natural_log.h"
#include "derivation/strip.h"
#include "search/gauges.h"
#include "search/packing_scorer.h"
#include "search/require.h"
#include "search/score_weight.h"

namespace espalier {
namespace {

constexpr double kWeightless = -std::numeric_limits<double>::infinity();

}  // namespace

GuidedEngine::GuidedEngine(const SearchProblem& problem, const GuidedSettings& settings)
    : problem_(problem), settings_(validated(settings)), pool_(*problem.graph) {
  CHECK(problem_.scorer != nullptr);
  scorer_ = problem_.scorer->make_growth_scorer();
  if (!scorer_) scorer_ = std::make_unique<PackingScorer>(*problem_.scorer);
}

GuidedEngine::~GuidedEngine() = default;

const Individual& GuidedEngine::best() const {
  CHECK(steps_ > 0);
  pack_best();
  return best_individual_;
}

void GuidedEngine::pack_best() const {
  if (!best_packed_) best_individual_ = {pool_.pack(best_), best_score_};
  best_packed_ = true;
}

std::span<const Individual> GuidedEngine::population() const {
  if (steps_ == 0) return {};
  return population_.empty() ? std::span(&best(), 1) : std::span<const Individual>(population_);
}

std::uint32_t GuidedEngine::particles_at(std::uint64_t step) const {
  if (!seeded_) return settings_.regrow_particles;
  if (settings_.steps < 2) return settings_.particles;
  const double share = static_cast<double>(step) / (settings_.steps - 1);
  const double fall = static_cast<double>(settings_.particles - settings_.last_particles);
  return static_cast<std::uint32_t>(std::ceil(settings_.particles - fall * share));
}

double GuidedEngine::heuristic_at(std::uint64_t step) const {
  const auto end = static_cast<double>(std::min(settings_.heuristic_steps, settings_.steps - 1));
  const auto at = static_cast<double>(step);
  return seeded_ && at < end ? settings_.heuristic * (1 - at / end) : 0;
}

void GuidedEngine::step() {
  if (over_) {
    population_.clear();
    if (steps_ == 0 && !problem_.founders.empty()) take_founders();
    // What locks hold is known by its place in the pool.
    if (has_best_ && settings_.regrow && (best_pooled_ || problem_.locks.empty())) {
      begin_round();
    } else {
      begin_sweep();
    }
    over_ = false;
  }
  grow_particles();
  weigh();
  ++sweep_step_;
  ++steps_;
  over_ = sweep_step_ >= sweep_length_ ||
          std::all_of(particles_.begin(), particles_.end(), [&](const GrowingDerivation& particle) {
            return particle.open.empty() || particle.genes >= settings_.genes.max;
          });
  if (over_) {
    end_sweep();
  } else {
    resample_particles();
    tidy_pool(1'000'000);
  }
}

void GuidedEngine::begin_sweep() {
  if (has_best_) pack_best();  // before the pool forgets it
  best_pooled_ = false;
  seeded_ = true;
  sweep_step_ = 0;
  log_mean_ = 0;
  sweep_length_ = settings_.steps;
  pool_.clear();
  const std::uint32_t particles = particles_at(0);
  scorer_->begin(particles);
  particles_.resize(particles);
  const Derivation start = problem_.locks.empty() ? Derivation() : locked_start();
  for (std::uint32_t i = 0; i < particles; ++i) {
    RandomStream random({problem_.seed, Purpose::initial, problem_.lane, i, static_cast<std::uint32_t>(steps_)});
    particles_[i] = start.genes.empty() ? pool_.begin(random) : pool_.begin(start);
    run_genes(i, particles_[i]);
  }
  pinned_ = static_cast<std::uint32_t>(history_.size());  // the start gene, or what locks hold
  log_weights_.assign(particles, 0);
  accounts_.assign(particles, {});
}

/// What locks hold; the rest is to grow anew.
Derivation GuidedEngine::locked_start() const {
  Derivation start = stripped(*problem_.graph, problem_.founders.front().derivation, problem_.locks);
  reopen(*problem_.graph, start, problem_.locks);
  return start;
}

/// The best of the founders is the best so far.
void GuidedEngine::take_founders() {
  const auto best = std::max_element(problem_.founders.begin(), problem_.founders.end(),
                                     [](const Individual& a, const Individual& b) { return a.score < b.score; });
  best_individual_ = *best;
  best_score_ = best->score;
  has_best_ = best_packed_ = true;
  scorer_->begin(1);
}

/// The scorer learns of all genes of a derivation.
void GuidedEngine::run_genes(std::size_t place, const GrowingDerivation& growing) {
  pool_.history(growing, history_);
  for (const ShootId shoot : history_) {
    if (pool_.shoot(shoot).filled) scorer_->grown(place, pool_, shoot);
  }
}

void GuidedEngine::begin_round() {
  seeded_ = false;
  sweep_step_ = 0;
  round_began_with_ = best_score_;
  if (!best_pooled_) {
    best_ = pool_.begin(best_individual_.derivation);
    scorer_->clear(0);
    run_genes(0, best_);
    best_pooled_ = true;
  }
  particles_.clear();
  tidy_pool(20'000);
  choose_cuts();
  const ShootId first = static_cast<ShootId>(pool_.shoots());
  const GrowingDerivation cut = pool_.cut_back(best_, history_, parents_, cut_, kept_);
  scorer_->clear(0);
  std::uint64_t kept = 0;
  for (std::uint32_t k = 0; k < kept_.size(); ++k) {
    const GrowthPool::Shoot& shoot = pool_.shoot(first + k);
    kept += pool_.makes_something(shoot);
    if (shoot.filled) scorer_->grown_again(0, first + k, history_[kept_[k]]);
  }
  counts_.taken_back += sizes_[0] - kept;
  sweep_length_ = std::max<std::uint64_t>(settings_.steps, sizes_[0]) - kept;
  const std::uint32_t particles = particles_at(0);
  particles_.assign(particles, cut);
  ancestors_.assign(particles, 0);
  scorer_->follow(ancestors_);
  score_particles();
  log_weights_.assign(particles, 0);
  accounts_.resize(particles);
  for (std::size_t i = 0; i < particles; ++i) accounts_[i] = {scores_[i], 0};
}

/// Which shoots of the best are taken back: all subtrees that are worth less than nothing, others at random up to
/// `regrow_steps`, and every second decision to leave a slot empty.
void GuidedEngine::choose_cuts() {
  RandomStream random({problem_.seed, Purpose::select, problem_.lane, 0, static_cast<std::uint32_t>(steps_)});
  pool_.history(best_, history_);
  const std::size_t shoots = history_.size();
  cut_.assign(shoots, 0);
  worth_.assign(shoots, 0);
  sizes_.assign(shoots, 0);
  pool_.parents(history_, parents_);
  for (std::size_t i = 0; i < shoots; ++i) {
    const GrowthPool::Shoot& shoot = pool_.shoot(history_[i]);
    if (!shoot.filled) continue;
    worth_[i] = scorer_->worth(history_[i]);
    sizes_[i] = pool_.makes_something(shoot);
  }
  for (std::size_t i = shoots; i-- > 1;) {
    worth_[parents_[i]] += worth_[i];
    sizes_[parents_[i]] += sizes_[i];
  }
  std::uint64_t taken = 0;
  for (std::size_t i = pinned_; i < shoots; ++i) {
    if (cut_[parents_[i]]) cut_[i] = 1;
    if (cut_[i]) continue;
    const bool filled = pool_.shoot(history_[i]).filled;
    cut_[i] = filled ? worth_[i] < 0 : random.chance(0.5);
    if (cut_[i]) taken += sizes_[i];
  }
  const std::uint64_t wanted = taken + 1 + random.below(settings_.regrow_steps);
  constexpr int kMostTries = 64;
  for (int tries = 0; tries < kMostTries && taken < wanted && shoots > pinned_; ++tries) {
    const std::size_t i = pinned_ + random.below(static_cast<std::uint32_t>(shoots - pinned_));
    if (cut_[i] || sizes_[i] == 0 || taken + sizes_[i] > wanted) continue;
    taken += sizes_[i];
    cut_[i] = 1;
    for (std::size_t k = i + 1; k < shoots; ++k) {
      if (cut_[parents_[k]]) cut_[k] = 1;
    }
  }
}

void GuidedEngine::grow_particles() {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (particles_[i].open.empty()) continue;
    RandomStream random({problem_.seed, Purpose::vary, problem_.lane, static_cast<std::uint32_t>(i),
                         static_cast<std::uint32_t>(steps_)});
    const GrowthStep grown =
        pool_.grow(particles_[i], random, settings_.genes.max,
                   [&](ShootId shoot) { scorer_->grown(i, pool_, shoot); });
    evaluations_ += grown == GrowthStep::grown;
  }
  score_particles();
}

void GuidedEngine::score_particles() {
  scores_.resize(particles_.size());
  scorer_->score(pool_, particles_, scores_);
}

void GuidedEngine::weigh() {
  const double beta = 1 / settings_.temperature;
  const double before = sweep_step_ > 0 ? heuristic_at(sweep_step_ - 1) : 0, now = heuristic_at(sweep_step_);
  promises_.assign(particles_.size(), 0);
  if (now > 0) scorer_->promise(pool_, particles_, promises_);
  double sum = 0;
  std::size_t living = 0, best = particles_.size();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Account& account = accounts_[i];
    if (scores_[i] == kNotAcceptable || log_weights_[i] == kWeightless) {
      log_weights_[i] = kWeightless;
      continue;
    }
    log_weights_[i] += beta * (scores_[i] - account.score + now * promises_[i] - before * account.promise);
    account = {scores_[i], promises_[i]};
    sum += scores_[i];
    ++living;
    if (particles_[i].genes < settings_.genes.min) continue;
    if (best == particles_.size() || scores_[i] > scores_[best]) best = i;
  }
  mean_score_ = living > 0 ? sum / static_cast<double>(living) : best_score_;
  if (best == particles_.size() || (has_best_ && scores_[best] <= best_score_)) return;
  best_ = particles_[best];
  best_score_ = scores_[best];
  has_best_ = best_pooled_ = true;
  best_packed_ = false;
}

void GuidedEngine::resample_particles() {
  const std::uint32_t places = particles_at(sweep_step_);
  if (!normalise(log_weights_, weights_)) {
    over_ = true;  // none is left
    return end_sweep();
  }
  effective_ = effective_size(weights_);
  log_mean_ += log_sum(log_weights_) - natural_log(static_cast<double>(log_weights_.size()));
  RandomStream random({problem_.seed, Purpose::resample, problem_.lane, 0, static_cast<std::uint32_t>(steps_)});
  resample(settings_.resampling, weights_, places, random, ancestors_);
  scratch_.resize(places);
  account_scratch_.resize(places);
  for (std::size_t k = 0; k < places; ++k) {
    scratch_[k] = particles_[ancestors_[k]];
    account_scratch_[k] = accounts_[ancestors_[k]];
  }
  particles_.swap(scratch_);
  accounts_.swap(account_scratch_);
  scorer_->follow(ancestors_);
  log_weights_.assign(places, 0);
}

void GuidedEngine::end_sweep() {
  for (const GrowingDerivation& particle : particles_) counts_.finished_particles += particle.open.empty();
  if (!seeded_) {
    ++counts_.rounds;
    counts_.improved += best_score_ > round_began_with_;
    return;
  }
  ++counts_.sweeps;
  log_evidence_ = log_mean_ + log_sum(log_weights_) - natural_log(static_cast<double>(log_weights_.size()));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (log_weights_[i] != kWeightless) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores_[a] > scores_[b]; });
  std::vector<double> log_weights;
  for (const std::size_t i : order) {
    population_.push_back({pool_.pack(particles_[i]), scores_[i]});
    log_weights.push_back(log_weights_[i]);
  }
  log_weights_ = std::move(log_weights);
}

/// Forgets what no particle holds, once the pool has so many shoots.
void GuidedEngine::tidy_pool(std::size_t most) {
  if (pool_.shoots() < std::max(most, tidy_at_)) return;
  std::vector<GrowingDerivation*> living;
  for (GrowingDerivation& particle : particles_) living.push_back(&particle);
  if (best_pooled_) living.push_back(&best_);
  pool_.keep_only(living, renumbering_);
  scorer_->renumber(renumbering_);
  tidy_at_ = 4 * pool_.shoots();
}

}  // namespace espalier
