// How the genetic algorithm makes the next generation. (ShapeGenetics 2017, Algorithm 1.)
#include <algorithm>

#include "search/ga.h"

namespace espalier {
namespace {

// Of a pair, in vain or not. Enough that a limit met by one child in ten is missed once in 10^9.
constexpr std::uint32_t kMostRedraws = 200;

}  // namespace

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
  broods_.clear();
  const auto generation = static_cast<std::uint32_t>(steps_);
  for (std::size_t place = elite; place < newcomers_.size(); place += 2) {
    const auto pair = static_cast<std::uint32_t>(broods_.size());
    broods_.push_back({RandomStream({problem_.seed, Purpose::select, problem_.lane, pair, generation}),
                       RandomStream({problem_.seed, Purpose::vary, problem_.lane, pair, generation})});
    const std::size_t places[2] = {place, place + 1};
    breed(broods_.back(), std::span(places).first(std::min<std::size_t>(2, newcomers_.size() - place)));
  }
}

void GaEngine::redraw_children() {
  counts_.rejected_children += rejected_.size();
  for (const std::size_t place : rejected_) {
    if (settings_.unique) born_.erase(hash(newcomers_[place].derivation));
  }
  const std::span<const std::size_t> all = rejected_;
  const auto pair_of = [&](std::size_t i) { return (all[i] - settings_.elitism) / 2; };
  for (std::size_t i = 0; i < all.size();) {
    const std::size_t both = i + 1 < all.size() && pair_of(i + 1) == pair_of(i) ? 2 : 1;
    breed(broods_[pair_of(i)], all.subspan(i, both));
    i += both;
  }
}

/// Fills the places with children that may be scored, from where the pair's streams stand; with parents where the
/// pair's attempts are used up.
void GaEngine::breed(Brood& brood, std::span<const std::size_t> places) {
  std::size_t made = 0;
  for (; brood.attempts < kMostRedraws && made < places.size(); ++brood.attempts) {
    const std::uint32_t first = first_.pick(brood.choosing), second = second_.pick(brood.choosing);
    variation_.vary(population_[first], population_[second], brood.varying, children_[0], children_[1], counts_);
    children_[0].parent = first, children_[1].parent = second;
    for (Child& child : children_) {
      if (made == places.size()) break;
      const std::size_t genes = child.individual.derivation.size();
      if (genes < settings_.genes.min || genes > settings_.genes.max) {
        ++counts_.redrawn_children;
      } else if (settings_.unique && !born_.insert(hash(child.individual.derivation)).second) {
        ++counts_.redrawn_twins;
      } else {
        admit(child, places[made++]);
      }
    }
  }
  for (; made < places.size(); ++made) {
    newcomers_[places[made]] = population_[first_.pick(brood.choosing)];
    scored_[places[made]] = 1;
    parents_[places[made]] = Child::kNone;
    ++counts_.kept_parents;
  }
}

void GaEngine::admit(Child& child, std::size_t place) {
  const bool known = child.scored || (settings_.reuse_scores && find_known(child.individual));
  counts_.reused_scores += known;
  scored_[place] = known;
  parents_[place] = child.parent;
  kinds_[place] = child.kind;
  if (known && !child.scored) tally(place, child.individual.score);
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

}  // namespace espalier
