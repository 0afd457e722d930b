#include "search/selection.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace espalier {

std::string_view name_of(SelectionScheme scheme) {
  switch (scheme) {
    case SelectionScheme::roulette: return "roulette";
    case SelectionScheme::tournament: return "tournament";
    case SelectionScheme::random: return "random";
  }
  CHECK(false);
}

void Selection::prepare(std::span<const double> scores) {
  CHECK(!scores.empty());
  for (const double score : scores) CHECK(std::isfinite(score));
  scores_.assign(scores.begin(), scores.end());
  if (scheme_ != SelectionScheme::roulette) return;
  const double worst = *std::min_element(scores_.begin(), scores_.end());
  cumulative_.resize(scores_.size());
  double sum = 0;
  for (std::size_t i = 0; i < scores_.size(); ++i) cumulative_[i] = sum += scores_[i] - worst;
}

std::uint32_t Selection::pick(RandomStream& random) const {
  switch (scheme_) {
    case SelectionScheme::roulette: return pick_by_roulette(random);
    case SelectionScheme::tournament: return pick_by_tournament(random);
    case SelectionScheme::random: return random.below(static_cast<std::uint32_t>(scores_.size()));
  }
  CHECK(false);
}

std::uint32_t Selection::pick_by_roulette(RandomStream& random) const {
  const double sum = cumulative_.back();
  if (!(sum > 0)) return random.below(static_cast<std::uint32_t>(scores_.size()));
  // The first sector that ends beyond the ball; sectors of no width are never hit.
  const double ball = random.next_unit() * sum;
  const auto sector = std::upper_bound(cumulative_.begin(), cumulative_.end(), ball);
  // The product may round up to the sum itself: then the last sector that has a width.
  if (sector == cumulative_.end()) {
    return static_cast<std::uint32_t>(std::lower_bound(cumulative_.begin(), cumulative_.end(), sum) -
                                      cumulative_.begin());
  }
  return static_cast<std::uint32_t>(sector - cumulative_.begin());
}

std::uint32_t Selection::pick_by_tournament(RandomStream& random) const {
  const auto n = static_cast<std::uint32_t>(scores_.size());
  std::uint32_t best = random.below(n);
  for (std::uint32_t i = 1; i < size_; ++i) {
    const std::uint32_t rival = random.below(n);
    if (scores_[rival] > scores_[best] || (scores_[rival] == scores_[best] && rival < best)) best = rival;
  }
  return best;
}

}  // namespace espalier
