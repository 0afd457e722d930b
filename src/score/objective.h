#pragma once
// What engines see of scoring: a batch of derivations in, their scores out. Threads, models and targets stay behind it.

#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "derivation/derivation.h"

namespace espalier {

/// The score of what is not acceptable.
inline constexpr double kNotAcceptable = -std::numeric_limits<double>::infinity();

class BatchScorer {
 public:
  virtual ~BatchScorer() = default;

  /// scores[i] = score of *derivations[i]; higher is better. Finite, or kNotAcceptable (beyond a
  /// hard limit): engines never keep that, but redraw it. The same for any number of threads.
  virtual void score(std::span<const Derivation* const> derivations, std::span<double> scores) = 0;

  /// The best score that any model could have (it need not be reachable).
  virtual double optimum() const = 0;

  /// For messages: what was not acceptable so far, and by which limits.
  virtual std::string describe_rejections() const { return ""; }
};

}  // namespace espalier
