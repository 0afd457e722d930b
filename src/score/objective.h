#pragma once
// What engines see of scoring: a batch of derivations in, their scores out. Threads, models and targets stay behind it.

#include <cstdint>
#include <span>

#include "derivation/derivation.h"

namespace espalier {

class BatchScorer {
 public:
  virtual ~BatchScorer() = default;

  /// scores[i] = score of *derivations[i]; higher is better. Finite, and the same for any number of threads.
  virtual void score(std::span<const Derivation* const> derivations, std::span<double> scores) = 0;

  /// The best score that any model could have (it need not be reachable).
  virtual double optimum() const = 0;
};

}  // namespace espalier
