#include "run/rises.h"

#include <algorithm>

namespace espalier {

void Rises::add(const StepReport& report) {
  last_ = {report.evaluations, report.seconds, report.best};
  if (empty() || report.best > rises_.rows().back().row.best) rises_.add(count_++, last_);
}

std::optional<double> Rises::at(Effort effort, double so_much) const {
  if (empty() || so_much < first(effort) || so_much > last(effort)) return std::nullopt;
  const auto& rows = rises_.rows();
  const auto after = std::upper_bound(rows.begin(), rows.end(), so_much, [&](double value, const auto& numbered) {
    return value < spent(numbered.row, effort);
  });
  return (after - 1)->row.best;
}

std::optional<double> Rises::reaching(Effort effort, double score, Effort limited, double most) const {
  const auto& rows = rises_.rows();
  const auto found = std::lower_bound(rows.begin(), rows.end(), score,
                                      [](const auto& numbered, double value) { return numbered.row.best < value; });
  if (found == rows.end() || spent(found->row, limited) > most) return std::nullopt;
  return spent(found->row, effort);
}

}  // namespace espalier
