#include "search/guided_settings.h"

#include "search/require.h"

namespace espalier {

void validate(const GuidedSettings& s) {
  require_range("particles", s.particles, 2u, 1'000'000u);
  require_range("last_particles", s.last_particles, 2u, s.particles);
  require_range("steps", s.steps, 1u, 100'000u);
  require_range("heuristic", s.heuristic, 0.0, 1e6);
  require_range("heuristic_steps", s.heuristic_steps, 0u, 100'000u);
  require_range("temperature", s.temperature, 1e-12, 1e12);
  require_range("regrow_particles", s.regrow_particles, 2u, 1'000'000u);
  require_range("regrow_steps", s.regrow_steps, 1u, 100'000u);
}

std::string to_text(const GuidedSettings& s) {
  return fmt::format("particles {}..{} steps {} heuristic {} to {} temperature {} resample {} regrow {} {} x {} genes "
                     "{}..{}",
                     s.particles, s.last_particles, s.steps, s.heuristic, s.heuristic_steps, s.temperature,
                     name_of(s.resampling), s.regrow, s.regrow_particles, s.regrow_steps, s.genes.min, s.genes.max);
}

}  // namespace espalier
