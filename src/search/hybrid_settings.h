#pragma once
// Settings of the hybrid engine.

#include <cstdint>
#include <string>

#include "search/ga_settings.h"
#include "search/rjmcmc_settings.h"
#include "search/smc_settings.h"

namespace espalier {

struct HybridSettings {
  SmcSettings start;
  GaSettings middle;
  RjmcmcSettings end;
  std::uint32_t sweeps = 1;                 // of the start, 1..1000
  std::uint64_t start_evaluations = 2'000;  // then the start gives way even in the middle of a sweep, 1..1e12
  std::uint64_t turn = 3'000;               // evaluations between decisions which of the other two goes on, 1..1e12

  bool operator==(const HybridSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const HybridSettings& settings);

}  // namespace espalier
