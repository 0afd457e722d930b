#pragma once
// Picks one of several weighted candidates.

#include <cstddef>
#include <vector>

#include "base/random.h"

namespace espalier {

/// Index of a candidate, with probability proportional to candidates[i].weight > 0; `total` is the sum of the weights
/// in their order. At least one candidate.
template <class Candidate>
std::size_t pick_weighted(const std::vector<Candidate>& candidates, double total, RandomStream& random) {
  double rest = random.next_unit() * total;
  std::size_t i = 0;
  while (i + 1 < candidates.size() && rest >= candidates[i].weight) rest -= candidates[i++].weight;
  return i;
}

}  // namespace espalier
