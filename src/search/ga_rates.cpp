#include "search/ga_rates.h"

#include <numeric>

namespace espalier {
namespace {

// So many children of mean success are added to those of every kind: few children prove little.
constexpr double kPrior = 20;
// What a kind keeps of its given chance, whatever it brings: it may be needed later, and must go on being tried.
constexpr double kKept = 0.5;

}  // namespace

VariationRates rates_of(const GaSettings& s) {
  VariationRates rates;
  const double shares[] = {s.grow, s.cut, s.alter, s.nudge};
  const double sum = std::accumulate(std::begin(shares), std::end(shares), 0.0);
  for (std::size_t k = 0; k < std::size(shares); ++k) rates.chance[k] = sum > 0 ? s.mutation * shares[k] / sum : 0;
  rates.chance[static_cast<std::size_t>(VariationKind::crossover)] = 1 - s.mutation;
  return rates;
}

VariationRates adapted(const VariationRates& given, const GaGains& gains) {
  double made = 0, better = 0;
  for (std::size_t k = 0; k < kVariationKinds; ++k) {
    made += static_cast<double>(gains.made(static_cast<VariationKind>(k)));
    better += static_cast<double>(gains.better(static_cast<VariationKind>(k)));
  }
  if (!(better > 0)) return given;
  std::array<double, kVariationKinds> success{};
  for (std::size_t k = 0; k < kVariationKinds; ++k) {
    const auto kind = static_cast<VariationKind>(k);
    if (!(given.chance[k] > 0)) continue;
    success[k] = (static_cast<double>(gains.better(kind)) + kPrior * better / made) /
                 (static_cast<double>(gains.made(kind)) + kPrior);
  }
  const double sum = std::accumulate(success.begin(), success.end(), 0.0);
  VariationRates rates;
  for (std::size_t k = 0; k < kVariationKinds; ++k) {
    rates.chance[k] = kKept * given.chance[k] + (1 - kKept) * success[k] / sum;
  }
  return rates;
}

}  // namespace espalier
