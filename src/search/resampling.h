#pragma once
// Resampling of weighted particles: which particle stands for which, next. Each scheme gives particle i a number of
// places whose mean is n * w[i]; they differ in variance. (Douc, Cappé and Moulines 2005; Doucet and Johansen 2009,
// section 3.4.) Weights live in log space until here.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/random.h"

namespace espalier {

enum class Resampling : std::uint8_t {
  systematic,   // one uniform number for all: floor or ceiling of n * w[i] places
  stratified,   // one in each of n equal strata
  multinomial,  // n independent ones
  residual,     // floor(n * w[i]) places each, the rest multinomially from what is left over
};

std::string_view name_of(Resampling scheme);

/// log sum exp(log_weights), without overflow; -infinity where all are, or for none.
double log_sum(std::span<const double> log_weights);

/// weights[i] = exp(log_weights[i]) / sum. False, and weights unchanged, where every log weight is -infinity. None may
/// be NaN or +infinity.
bool normalise(std::span<const double> log_weights, std::vector<double>& weights);

/// 1 / sum w^2 of weights that sum to 1: between 1 and their number (Kong, Liu and Wong 1994).
double effective_size(std::span<const double> weights);

/// ancestors = for each of `count` places the index of the particle that takes it, ascending. `weights` >= 0 with sum
/// 1 (rounding aside), at least one. A particle of weight 0 gets no place.
void resample(Resampling scheme, std::span<const double> weights, std::uint32_t count, RandomStream& random,
              std::vector<std::uint32_t>& ancestors);

}  // namespace espalier
