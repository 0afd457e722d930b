#include "search/ga.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "derivation/sample.h"

namespace espalier {
namespace {

// Enough that a limit met by one child in ten is missed once in 10^9.
constexpr std::uint32_t kMostRedraws = 200;
constexpr std::uint32_t kMostStarts = 100;

GaSettings validated(const GaSettings& settings) {
  validate(settings);
  return settings;
}

}  // namespace

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
  newcomers_.resize(settings_.population);
  scored_.assign(settings_.population, 0);
  const double best_before = steps_ == 0 ? 0 : population_.front().score;
  const bool anew = steps_ == 0 || restart_is_due();
  if (steps_ > 0 && anew) restart();
  if (anew) {
    make_initial_population();
  } else {
    make_next_generation();
  }
  score_newcomers();
  sort_newcomers();
  if (steps_ == 0 || population_.front().score > best_.score) best_ = population_.front();
  stalled_ = anew || population_.front().score > best_before ? 0 : stalled_ + 1;
  ++steps_;
}

void GaEngine::make_initial_population() {
  for (std::uint32_t i = 0; i < settings_.population; ++i) newcomers_[i].derivation = make_individual(i);
  if (champions_.size() < kReunion) return;
  for (std::size_t i = 0; i < champions_.size() && i < newcomers_.size(); ++i) {
    newcomers_[i] = champions_[i];
    scored_[i] = 1;
  }
  champions_.clear();
}

bool GaEngine::restart_is_due() const { return settings_.restart_after > 0 && stalled_ >= settings_.restart_after; }

void GaEngine::restart() {
  champions_.push_back(population_.front());
  ++epoch_;
  ++counts_.restarts;
}

Derivation GaEngine::make_individual(std::uint32_t index) {
  const std::uint32_t low = std::max(settings_.initial_length_min, settings_.genes.min);
  const std::uint32_t high = std::min(settings_.initial_length_max, settings_.genes.max);
  for (std::uint32_t attempt = 0; attempt < kMostStarts; ++attempt) {
    RandomStream random({problem_.seed, Purpose::initial, problem_.lane, index, epoch_ * kMostStarts + attempt});
    const std::uint32_t length = low + random.below(high - low + 1);
    Derivation derivation = seedling(*problem_.graph, random);
    close_open_slots(*problem_.graph, derivation, random);
    while (derivation.size() < length && grow(*problem_.graph, derivation, problem_.locks, random)) {}
    // Required slots bring several genes at once, so the limits may be overshot.
    if (derivation.size() < settings_.genes.min || derivation.size() > settings_.genes.max) continue;
    counts_.short_starts += derivation.size() < length;
    return derivation;
  }
  throw Error(fmt::format("grammar {} grew no derivation of {} to {} genes in {} attempts (limits.genes)",
                          problem_.graph->name, settings_.genes.min, settings_.genes.max, kMostStarts));
}

void GaEngine::make_next_generation() {
  scores_.resize(population_.size());
  for (std::size_t i = 0; i < population_.size(); ++i) scores_[i] = population_[i].score;
  first_.prepare(scores_);
  second_.prepare(scores_);
  remember_population();

  born_.clear();
  const std::size_t elite = settings_.elitism;
  for (std::size_t i = 0; i < elite; ++i) {
    newcomers_[i] = population_[i];
    scored_[i] = 1;
    if (settings_.unique) born_.insert(hash(newcomers_[i].derivation));
  }
  std::uint32_t pair = 0;
  for (std::size_t place = elite; place < newcomers_.size(); place += 2, ++pair) {
    breed_pair(pair, place, std::min<std::size_t>(2, newcomers_.size() - place));
  }
}

void GaEngine::breed_pair(std::uint32_t pair, std::size_t first_child, std::size_t children) {
  const auto generation = static_cast<std::uint32_t>(steps_);
  RandomStream choosing({problem_.seed, Purpose::select, problem_.lane, pair, generation});
  RandomStream varying({problem_.seed, Purpose::vary, problem_.lane, pair, generation});
  std::size_t made = 0;
  for (std::uint32_t attempt = 0; attempt < kMostRedraws && made < children; ++attempt) {
    const Individual& parent1 = population_[first_.pick(choosing)];
    const Individual& parent2 = population_[second_.pick(choosing)];
    variation_.vary(parent1, parent2, varying, children_[0], children_[1], counts_);
    for (Child& child : children_) {
      if (made == children) break;
      const std::size_t genes = child.individual.derivation.size();
      if (genes < settings_.genes.min || genes > settings_.genes.max) {
        ++counts_.redrawn_children;
      } else if (settings_.unique && !born_.insert(hash(child.individual.derivation)).second) {
        ++counts_.redrawn_twins;
      } else {
        admit(child, first_child + made++);
      }
    }
  }
  for (; made < children; ++made) {
    newcomers_[first_child + made] = population_[first_.pick(choosing)];
    scored_[first_child + made] = 1;
    ++counts_.kept_parents;
  }
}

void GaEngine::admit(Child& child, std::size_t place) {
  const bool known = child.scored || (settings_.reuse_scores && find_known(child.individual));
  counts_.reused_scores += known;
  scored_[place] = known;
  std::swap(newcomers_[place], child.individual);
}

void GaEngine::remember_population() {
  if (!settings_.reuse_scores) return;
  known_.clear();
  for (std::size_t i = 0; i < population_.size(); ++i) known_.push_back({hash(population_[i].derivation), i});
  std::sort(known_.begin(), known_.end(), [](const Known& a, const Known& b) {
    return a.hash != b.hash ? a.hash < b.hash : a.index < b.index;
  });
}

bool GaEngine::find_known(Individual& individual) const {
  const std::uint64_t wanted = hash(individual.derivation);
  auto at = std::lower_bound(known_.begin(), known_.end(), wanted,
                             [](const Known& known, std::uint64_t h) { return known.hash < h; });
  for (; at != known_.end() && at->hash == wanted; ++at) {
    if (!(population_[at->index].derivation == individual.derivation)) continue;
    individual.score = population_[at->index].score;
    return true;
  }
  return false;
}

void GaEngine::score_newcomers() {
  batch_.clear();
  batch_places_.clear();
  for (std::size_t i = 0; i < newcomers_.size(); ++i) {
    if (scored_[i]) continue;
    batch_.push_back(&newcomers_[i].derivation);
    batch_places_.push_back(i);
  }
  scores_.resize(batch_.size());
  if (!batch_.empty()) problem_.scorer->score(batch_, scores_);
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    CHECK(std::isfinite(scores_[i]));
    newcomers_[batch_places_[i]].score = scores_[i];
  }
  evaluations_ += batch_.size();
}

void GaEngine::sort_newcomers() {
  order_.resize(newcomers_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return newcomers_[a].score != newcomers_[b].score ? newcomers_[a].score > newcomers_[b].score : a < b;
  });
  // The old population is spent: its places take the sorted newcomers, and give their storage in return.
  population_.resize(newcomers_.size());
  for (std::size_t rank = 0; rank < order_.size(); ++rank) std::swap(population_[rank], newcomers_[order_[rank]]);
}

}  // namespace espalier
