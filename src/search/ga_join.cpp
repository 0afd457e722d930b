// How the genetic algorithm joins what several children of one parent gained.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/check.h"
#include "derivation/encode.h"
#include "search/ga.h"

namespace espalier {

// All children that are better than their parents, by parent, best first.
void GaEngine::join_gains() {
  gainers_.clear();
  for (std::size_t i = 0; i < newcomers_.size(); ++i) {
    if (parents_[i] != Child::kNone && newcomers_[i].score > population_[parents_[i]].score) gainers_.push_back(i);
  }
  std::sort(gainers_.begin(), gainers_.end(), [this](std::size_t a, std::size_t b) {
    return std::tuple(parents_[a], -newcomers_[a].score, a) < std::tuple(parents_[b], -newcomers_[b].score, b);
  });
  const std::span<const std::size_t> all = gainers_;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && parents_[all[end]] == parents_[all[begin]]) ++end;
    join_of(all.subspan(begin, end - begin));
  }
}

// The joined child takes the place of the least of the parent's children that had gained, if it is better than the best
// of them.
void GaEngine::join_of(std::span<const std::size_t> places) {
  if (places.size() < 2) return;
  take_changes(places);
  if (changes_.size() < 2) return;
  Derivation& joined = children_[0].individual.derivation;
  join(*problem_.graph, population_[parents_[places[0]]].derivation, changes_, joined);
  if (!find_fault(*problem_.graph, joined).empty()) return;  // a rule has a limit
  ++counts_.joined_children;
  counts_.joined_changes += changes_.size();
  const Derivation* const batch[] = {&joined};
  double score = 0;
  problem_.scorer->score(batch, std::span(&score, 1));
  ++evaluations_;
  if (!(score > newcomers_[places[0]].score)) return;
  CHECK(std::isfinite(score));
  ++counts_.better_joins;
  const std::size_t place = places.back();
  std::swap(newcomers_[place].derivation, joined);
  newcomers_[place].score = score;
}

// Greedily, best first: changes that are apart from all before them and keep the gene limits.
void GaEngine::take_changes(std::span<const std::size_t> places) {
  changes_.clear();
  const Derivation& parent = population_[parents_[places[0]]].derivation;
  auto genes = static_cast<std::int64_t>(parent.size());
  for (const std::size_t place : places) {
    Change change;
    if (!find_change(*problem_.graph, parent, newcomers_[place].derivation, change)) continue;
    const bool apart = std::all_of(changes_.begin(), changes_.end(),
                                   [&](const Change& other) { return are_apart(change, other); });
    const std::int64_t after = genes + change.inserted.genes - std::int64_t{change.removed.genes};
    if (!apart || after < settings_.genes.min || after > settings_.genes.max) continue;
    genes = after;
    changes_.push_back(change);
  }
}

}  // namespace espalier
