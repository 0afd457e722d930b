#include "search/genesis_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "search/require.h"

namespace espalier {

std::string_view name_of(GenesisSelection selection) {
  return selection == GenesisSelection::proportional ? "proportional" : "ranking";
}

void validate(const GenesisSettings& s) {
  require_range("population", s.population, 2u, 100'000u);
  require_range("crossover", s.crossover, 0.0, 1.0);
  require_range("mutation", s.mutation, 0.0, 1.0);
  if (!(s.gap > 0 && s.gap <= 1)) throw Error(fmt::format("gap must be above 0 and at most 1, got {}", s.gap));
  require_range("window", s.window, 0u, 1'000'000u);
  require_range("rank_min", s.rank_min, 0.0, 1.0);
  require_range("idle", s.idle, 1u, 1000u);
  for (const std::uint32_t bits : s.bits) require_range("bits", bits, 1u, 32u);
}

std::string to_text(const GenesisSettings& s) {
  return fmt::format("P {} C {} M {} G {} select {} window {} rank_min {} elitism {} gray {} idle {} bits {}",
                     s.population, s.crossover, s.mutation, s.gap, name_of(s.selection), s.window, s.rank_min,
                     s.elitism, s.gray, s.idle, fmt::join(s.bits, " "));
}

}  // namespace espalier
