#pragma once
// How much scores count in what samplers sample: prior * weight(score)^(1 / temperature).

#include <cstdint>
#include <optional>

namespace espalier {

enum class ScoreWeight : std::uint8_t {
  exponential,  // exp(score)
  ratio,        // the score itself, which must be > 0: the papers' form
};

/// log of the weight of a score at temperature 1; kNotAcceptable stays what it is. Throws Error for a ratio of what is
/// not above 0.
double log_weight(ScoreWeight weight, double score);

/// 1 / temperature. Where none is given: of ratios 1; else the temperature is the optimum / `parts`, or 1 where no
/// score is above 0.
double inverse_temperature(ScoreWeight weight, const std::optional<double>& temperature, double optimum, double parts);

}  // namespace espalier
