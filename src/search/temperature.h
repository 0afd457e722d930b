#pragma once
// How much scores count in what samplers sample: prior * exp(score / temperature).

#include <cmath>
#include <optional>

namespace espalier {

/// 1 / temperature. Where none is given, the temperature is the optimum / `parts`, or 1 where no score is above 0.
inline double inverse_temperature(const std::optional<double>& temperature, double optimum, double parts) {
  if (temperature) return 1 / *temperature;
  return optimum > 0 && std::isfinite(optimum) ? parts / optimum : 1;
}

}  // namespace espalier
