#include "breed/settings.h"

#include "search/require.h"

namespace espalier {

std::string_view name_of(BreedMethod method) { return method == BreedMethod::classic ? "classic" : "free"; }

GenesisSettings BreedSettings::classic_genesis() {
  GenesisSettings settings;
  settings.population = kMostPopulation;
  return settings;
}

void validate(const BreedSettings& s) {
  require_range("population", s.population, BreedSettings::kLeastPopulation, BreedSettings::kMostPopulation);
  require_range("strength", s.strength, 0.0, 1.0);
  require_range("keep", s.keep, 0u, s.population - 1);
  require_range("crossover", s.crossover, 0.0, 1.0);
  require_range("blend", s.blend, 0.0, 1.0);
  require_range("lean", s.lean, 0.0, 1.0);
  require_range("newcomers", s.newcomers, 0.0, 1.0);
  validate(s.genesis);
}

}  // namespace espalier
