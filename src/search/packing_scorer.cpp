#include "search/packing_scorer.h"

#include <algorithm>

namespace espalier {

void PackingScorer::score(const GrowthPool& pool, std::span<const GrowingDerivation> growing,
                          std::span<double> scores) {
  packed_.clear();
  batch_.clear();
  for (const GrowingDerivation& one : growing) packed_.push_back(pool.pack(one));
  for (const Derivation& one : packed_) batch_.push_back(&one);
  if (!batch_.empty()) scorer_.score(batch_, scores);
}

void PackingScorer::promise(const GrowthPool&, std::span<const GrowingDerivation>, std::span<double> promises) {
  std::fill(promises.begin(), promises.end(), 0.0);
}

}  // namespace espalier
