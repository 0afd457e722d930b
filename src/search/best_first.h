#pragma once
// BestFirst: sorts individuals by score without allocating once warm, and lets what goes with them follow.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "search/engine.h"

namespace espalier {

class BestFirst {
 public:
  /// Best first; of equal scores, the one whose place has the lower `rank(place)`. Ranks must differ.
  template <typename Rank>
  void sort(std::vector<Individual>& individuals, Rank rank) {
    order_.resize(individuals.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      const double x = individuals[a].score, y = individuals[b].score;
      return x != y ? x > y : rank(a) < rank(b);
    });
    // Derivations change places and keep their storage.
    scratch_.resize(individuals.size());
    for (std::size_t i = 0; i < order_.size(); ++i) std::swap(scratch_[i], individuals[order_[i]]);
    individuals.swap(scratch_);
  }
  /// The same; equal ones stay in their order.
  void sort(std::vector<Individual>& individuals) {
    sort(individuals, [](std::size_t place) { return place; });
  }

  /// Moves values as the individuals were moved by the last sort.
  template <typename T>
  void follow(std::vector<T>& values, std::vector<T>& scratch) const {
    scratch.resize(values.size());
    for (std::size_t i = 0; i < order_.size(); ++i) scratch[i] = values[order_[i]];
    values.swap(scratch);
  }

 private:
  std::vector<std::size_t> order_;
  std::vector<Individual> scratch_;
};

}  // namespace espalier
