#pragma once
// Settings of the guided engine.

#include <cstdint>
#include <string>

#include "search/gene_limits.h"
#include "search/resampling.h"

namespace espalier {

struct GuidedSettings {
  /// Particles of the first step of a sweep and of its last; linear between (Guiding curves 2018, section 3.4; the
  /// numbers are those of its editor). 2..1000000, falling.
  std::uint32_t particles = 100, last_particles = 15;
  std::uint32_t steps = 100;      // of growth: as many genes with bones (or parts) as a model gets, 1..100000
  double heuristic = 0.013;       // of the first step, >= 0; falls linearly to 0 ...
  std::uint32_t heuristic_steps = 40;  // ... at this step; 0: none at all
  double temperature = 1;         // > 0
  Resampling resampling = Resampling::systematic;
  /// After the first sweep: rounds that take back a part of the best and grow it anew; else sweeps begin afresh.
  bool regrow = true;
  std::uint32_t regrow_particles = 16;  // of a round, 2..1000000
  std::uint32_t regrow_steps = 12;      // a round takes back up to so many, 1..100000
  GeneLimits genes = {};

  bool operator==(const GuidedSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const GuidedSettings& settings);
/// All of them in words: equal texts, equal settings.
std::string to_text(const GuidedSettings& settings);

}  // namespace espalier
