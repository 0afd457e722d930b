#pragma once
// Chances of Markov chains to accept, in logs; `beta` is 1 / temperature, and what is called a value is
// log weight(score) at temperature 1 (score_weight.h), -infinity for what is not acceptable.

#include <algorithm>

#include "base/natural_exp.h"
#include "base/natural_log.h"

namespace espalier {

/// Delayed rejection (Tierney and Mira 1999; Green and Mira 2001): `rejected` was drawn from the prior and rejected,
/// then `after` was proposed by a step that is as likely backwards. What the chance to accept it has beside
/// exp(beta * (after - before)): the way back would have been rejected first too, and fresh draws are as likely from
/// either side. All are values.
inline double log_delayed_ratio(double beta, double before, double rejected, double after) {
  const auto rejection = [&](double from) { return 1 - std::min(1.0, natural_exp(beta * (rejected - from))); };
  return natural_log(rejection(after)) - natural_log(rejection(before));
}

/// Of chains at two temperatures, to swap their states with these values.
inline double log_swap_ratio(double cold_beta, double hot_beta, double cold_value, double hot_value) {
  return (cold_beta - hot_beta) * (hot_value - cold_value);
}

}  // namespace espalier
