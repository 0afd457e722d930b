#pragma once
// VariationRates: the chances of the kinds of variation, as the settings have them, or as they follow what each kind
// brought lately (probability matching: Goldberg 1990; Thierens 2005).

#include <array>

#include "search/ga_gains.h"
#include "search/ga_settings.h"
#include "search/variation_kind.h"

namespace espalier {

/// Chance that a child is made by each kind; they sum to 1. A pair is crossed or mutated as one.
struct VariationRates {
  std::array<double, kVariationKinds> chance{};

  double of(VariationKind kind) const { return chance[static_cast<std::size_t>(kind)]; }
};

/// As the settings have them.
VariationRates rates_of(const GaSettings& settings);

/// Half of each chance is the given one; the other half goes to the kinds by the share of their children that were
/// better than their parents. What is never to happen never does. The given rates where nothing was better.
VariationRates adapted(const VariationRates& given, const GaGains& gains);

}  // namespace espalier
