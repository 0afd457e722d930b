#pragma once
// SearchLog: how a search went, step by step as progress and at intervals as gauges. Bounded however long the search is.

#include <cstdint>
#include <string>
#include <vector>

#include "run/progress.h"
#include "run/thinned.h"
#include "search/engine.h"
#include "search/state_stream.h"

namespace espalier {

/// Figures of the moment after a step; `values` in the order of the names of the log.
struct GaugeRow {
  StepReport report;
  std::vector<double> values;
};

class SearchLog {
 public:
  static constexpr std::size_t kMostSteps = 8192;
  static constexpr std::size_t kMostGaugeRows = 1024;

  void add(const StepReport& report) { steps_.add(report.step - 1, report); }
  /// Whether gauges after this step will be kept.
  bool wants_gauges(std::uint64_t step) const { return gauges_.keeps(step - 1); }
  /// The same names in the same order each time. Nothing happens where the step's gauges are there already.
  void add_gauges(const StepReport& report, const std::vector<NamedGauge>& gauges);

  /// The first step, the last, and those between as far as they are kept.
  std::vector<StepReport> steps() const;
  const std::vector<std::string>& gauge_names() const { return names_; }
  /// Of the last row; none before the first.
  std::vector<NamedGauge> last_gauges() const;
  const std::vector<Thinned<GaugeRow>::Numbered>& gauge_rows() const { return gauges_.rows(); }

  void save(StateWriter& writer) const;
  /// Throws Error for a damaged stream; the log is then as before.
  void load(StateReader& reader);

 private:
  Thinned<StepReport> steps_{kMostSteps};
  std::vector<std::string> names_;
  Thinned<GaugeRow> gauges_{kMostGaugeRows};
};

}  // namespace espalier
