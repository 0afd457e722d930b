#include "search/rjmcmc_settings.h"

#include "search/require.h"

namespace espalier {

void validate(const RjmcmcSettings& s) {
  require_range("chains", s.chains, 1u, 100'000u);
  require_range("temperatures", s.temperatures, 1u, s.chains);
  require_range("heat", s.heat, 1.0, 1e6);
  if (s.temperature) require_range("temperature", *s.temperature, 1e-12, 1e12);
  require_range("anneal", s.anneal, 1.0, 100.0);
  require_range("anneal_every", s.anneal_every, 1u, 1'000'000'000u);
  require_range("anneal_most", s.anneal_most, 1.0, 1e12);
  require_range("draws", s.draws, 0.0, 1e6);
  require_range("nudges", s.nudges, 0.0, 1e6);
  require_range("slots", s.slots, 0.0, 1e6);
  require_range("jumps", s.jumps, 0.0, 1e6);
  if (!(s.draws + s.nudges + s.slots + s.jumps > 0)) throw Error("draws + nudges + slots + jumps must be > 0, got 0");
  require_range("swap_every", s.swap_every, 0u, 1'000'000'000u);
  require_lengths(s.initial_length_min, s.initial_length_max, s.genes);
}

std::string to_text(const RjmcmcSettings& s) {
  return fmt::format("chains {} temperatures {} heat {} temperature {} anneal {} every {} most {} shares {} {} {} {} "
                     "choice {} delayed {} swap {} weight {} length {}..{} genes {}..{}",
                     s.chains, s.temperatures, s.heat, s.temperature.value_or(0), s.anneal, s.anneal_every,
                     s.anneal_most, s.draws, s.nudges, s.slots, s.jumps, static_cast<int>(s.choice), s.delayed,
                     s.swap_every, static_cast<int>(s.weight), s.initial_length_min, s.initial_length_max, s.genes.min,
                     s.genes.max);
}

}  // namespace espalier
