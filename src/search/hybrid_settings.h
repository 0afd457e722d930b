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
  std::uint32_t sweeps = 1;           // of the start, 1..1000
  std::uint64_t start_evaluations = 10'000;  // then the start gives way even in the middle of a sweep, 1..1e12
  std::uint64_t patience = 20'000;    // evaluations without a rise before the genetic algorithm gives way, 1..1e12
  double least_rise = 0.001;          // what counts as a rise, as a share of the optimum, 0..1

  bool operator==(const HybridSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const HybridSettings& settings);

}  // namespace espalier
