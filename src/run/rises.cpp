#include "run/rises.h"

#include <algorithm>

namespace espalier {

void Rises::add(const StepReport& report) {
  last_ = {report.evaluations, report.seconds, report.best};
  if (!rises_.empty() && report.best <= rises_.back().best) return;
  rises_.push_back(last_);
  if (rises_.size() < kMost) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rises_.size(); ++i) {
    if (i == 0 || i % 2 == 1) rises_[kept++] = rises_[i];  // the first and the last are among them
  }
  rises_.resize(kept);
}

std::optional<double> Rises::at(Effort effort, double so_much) const {
  if (rises_.empty() || so_much < first(effort) || so_much > last(effort)) return std::nullopt;
  const auto after = std::upper_bound(rises_.begin(), rises_.end(), so_much,
                                      [&](double value, const Rise& rise) { return value < spent(rise, effort); });
  return (after - 1)->best;
}

std::optional<double> Rises::reaching(Effort effort, double score) const {
  const auto found = std::lower_bound(rises_.begin(), rises_.end(), score,
                                      [](const Rise& rise, double value) { return rise.best < value; });
  if (found == rises_.end()) return std::nullopt;
  return spent(*found, effort);
}

}  // namespace espalier
