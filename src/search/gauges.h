#pragma once
// Gauges that several engines tell of their populations.

#include <limits>
#include <span>

#include "search/engine.h"

namespace espalier {

/// The value of a gauge that has nothing to tell yet.
inline constexpr double kNothingToTell = std::numeric_limits<double>::quiet_NaN();

/// part / whole; nothing to tell of nothing.
inline double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : kNothingToTell;
}

/// Different derivations (by hash) over individuals, above 0 to 1.
double share_distinct(std::span<const Individual> population);
double mean_score(std::span<const Individual> population);
double mean_genes(std::span<const Individual> population);
/// Standard deviation of the scores, of the population itself (divided by its size).
double score_deviation(std::span<const Individual> population);

}  // namespace espalier
