#include "search/smc_settings.h"

#include "search/require.h"

namespace espalier {

void validate(const SmcSettings& s) {
  require_range("particles", s.particles, 2u, 1'000'000u);
  require_range("schedule", s.schedule, 1.0, 100.0);
  require_range("most_particles", s.most_particles, s.particles, 1'000'000u);
  require_range("steps", s.most_steps, 1u, 1'000'000u);
  require_range("resample_below", s.resample_below, 0.0, 1.0);
  if (s.temperature) require_range("temperature", *s.temperature, 1e-12, 1e12);
  require_lengths(s.initial_length_min, s.initial_length_max, s.genes);
}

}  // namespace espalier
