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

std::string to_text(const SmcSettings& s) {
  return fmt::format("{} particles {} schedule {}..{} steps {} resample {} below {} weight {} temperature {} length "
                     "{}..{} genes {}..{}",
                     s.order == SlotOrder::random ? "sosmc" : "smc", s.particles, s.schedule, s.most_particles,
                     s.most_steps, name_of(s.resampling), s.resample_below, static_cast<int>(s.weight),
                     s.temperature.value_or(0), s.initial_length_min, s.initial_length_max, s.genes.min, s.genes.max);
}

}  // namespace espalier
