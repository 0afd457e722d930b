#pragma once
// What settings of engines must hold: each throws Error stating rule, setting and value.

#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "search/gene_limits.h"

namespace espalier {

/// low <= value <= high; NaN fails.
template <typename T>
void require_range(std::string_view name, T value, T low, T high) {
  if (!(value >= low && value <= high)) {
    throw Error(fmt::format("{} must be between {} and {}, got {}", name, low, high, value));
  }
}

/// The settings, if `validate` accepts them.
template <typename Settings>
const Settings& validated(const Settings& settings) {
  validate(settings);
  return settings;
}

/// Limits on genes, and lengths of first individuals that may lie within them.
inline void require_lengths(std::uint32_t shortest, std::uint32_t longest, const GeneLimits& genes) {
  require_range("genes.min", genes.min, 1u, 1'000'000u);
  require_range("genes.max", genes.max, genes.min, 1'000'000u);
  require_range("initial_length", shortest, 1u, 1'000'000u);
  require_range("initial_length (its upper end)", longest, shortest, 1'000'000u);
  if (longest < genes.min || shortest > genes.max) {
    throw Error(fmt::format("initial_length must overlap the gene limits {} to {}, got {} to {}", genes.min, genes.max,
                            shortest, longest));
  }
}

}  // namespace espalier
