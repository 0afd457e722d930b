#pragma once
// Settings of sequential Monte Carlo, in order (SMC) and in random order (SOSMC).

#include <cstdint>
#include <optional>
#include <string>

#include "derivation/sample.h"
#include "search/gene_limits.h"
#include "search/resampling.h"
#include "search/score_weight.h"

namespace espalier {

struct SmcSettings {
  SlotOrder order = SlotOrder::random;
  std::uint32_t particles = 500;        // of the first sweep, 2..1000000
  double schedule = 1;                  // each sweep has so many times the particles of the one before, 1..100
  std::uint32_t most_particles = 10'000;  // where the schedule ends, particles..1000000
  std::uint32_t most_steps = 10'000;    // of growth in a sweep; then what is unfinished is closed. 1..1000000
  Resampling resampling = Resampling::systematic;
  double resample_below = 0.5;  // share of particles: resample where the effective size is below; 1 = every step
  ScoreWeight weight = ScoreWeight::exponential;
  /// > 0; none: a 200th of the optimum, or 1 where that is not above 0; 1 with ratios.
  std::optional<double> temperature = std::nullopt;
  std::uint32_t initial_length_min = 50, initial_length_max = 50;  // of the individuals that are there from the start
  GeneLimits genes = {};

  bool operator==(const SmcSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const SmcSettings& settings);
/// All of them in words: equal texts, equal settings.
std::string to_text(const SmcSettings& settings);

}  // namespace espalier
