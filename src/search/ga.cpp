#include "search/ga.h"

#include <cmath>

#include "base/check.h"
#include "search/gauges.h"
#include "search/require.h"

namespace espalier {

GaEngine::GaEngine(const SearchProblem& problem, const GaSettings& settings)
    : problem_(problem),
      settings_(validated(settings)),
      variation_(*problem_.graph, problem_.locks, settings_),
      first_(settings_.first, settings_.tournament_size),
      second_(settings_.second, settings_.tournament_size) {
  CHECK(problem_.scorer != nullptr);
}

const Individual& GaEngine::best() const {
  CHECK(steps_ > 0);
  return best_;
}

void GaEngine::step() {
  const double best_before = steps_ == 0 ? 0 : population_.front().score;
  const bool anew = steps_ == 0 || restart_is_due();
  if (anew) {
    begin_population();
  } else {
    newcomers_.resize(settings_.population);
    scored_.assign(settings_.population, 0);
    parents_.assign(settings_.population, Child::kNone);
    kinds_.resize(settings_.population);
    if (settings_.adapt) variation_.set_rates(adapted(rates_of(settings_), gains_));
    gains_.begin_generation();
    make_next_generation();
    score_newcomers();
    while (!rejected_.empty()) {
      redraw_children();
      score_newcomers();
    }
    if (settings_.join) join_gains();
  }
  sort_newcomers();
  if (steps_ == 0 || population_.front().score > best_.score) best_ = population_.front();
  stalled_ = anew || population_.front().score > best_before ? 0 : stalled_ + 1;
  ++steps_;
}

void GaEngine::score_newcomers() {
  batch_.clear();
  batch_places_.clear();
  for (std::size_t i = 0; i < newcomers_.size(); ++i) {
    if (scored_[i]) continue;
    batch_.push_back(&newcomers_[i].derivation);
    batch_places_.push_back(i);
  }
  rejected_.clear();
  if (batch_.empty()) return;
  scores_.resize(batch_.size());
  problem_.scorer->score(batch_, scores_);
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const std::size_t place = batch_places_[i];
    tally(place, scores_[i]);
    if (scores_[i] == kNotAcceptable) {
      rejected_.push_back(place);
      continue;
    }
    CHECK(std::isfinite(scores_[i]));
    newcomers_[place].score = scores_[i];
    scored_[place] = 1;
  }
  evaluations_ += batch_.size();
}

/// Of a child that was made, not of a copy.
void GaEngine::tally(std::size_t place, double score) {
  gains_.add(kinds_[place], score > population_[parents_[place]].score);
}

std::vector<NamedGauge> GaEngine::gauges() const {
  std::vector<NamedGauge> all = {{"distinct", share_distinct(population_)},
                                 {"mean genes", mean_genes(population_)},
                                 {"score deviation", score_deviation(population_)}};
  for (std::size_t k = 0; k < kVariationKinds; ++k) {
    const auto kind = static_cast<VariationKind>(k);
    all.push_back({std::string("better by ") + kVariationNames[k], share_of(gains_.better(kind), gains_.made(kind))});
  }
  return all;
}

void GaEngine::sort_newcomers() {
  best_first_.sort(newcomers_);
  population_.swap(newcomers_);  // the old population is spent, and gives its storage
}

}  // namespace espalier
