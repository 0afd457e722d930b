#include "search/score_weight.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/natural_log.h"
#include "score/objective.h"

namespace espalier {

double log_weight(ScoreWeight weight, double score) {
  if (weight == ScoreWeight::exponential || score == kNotAcceptable) return score;
  if (!(score > 0)) {
    throw Error(fmt::format("weight \"ratio\" needs scores above 0, got {} (use \"exponential\")", score));
  }
  return natural_log(score);
}

double inverse_temperature(ScoreWeight weight, const std::optional<double>& temperature, double optimum,
                           double parts) {
  if (temperature) return 1 / *temperature;
  if (weight == ScoreWeight::ratio) return 1;
  return optimum > 0 && std::isfinite(optimum) ? parts / optimum : 1;
}

}  // namespace espalier
