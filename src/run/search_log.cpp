#include "run/search_log.h"

#include "base/check.h"
#include "base/error.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMostNames = 100'000;

void write_report(StateWriter& writer, const StepReport& report) {
  writer.u64(report.step);
  writer.u64(report.evaluations);
  writer.f64(report.seconds);
  writer.f64(report.best);
  writer.f64(report.mean);
  writer.u64(report.idle);
}

StepReport read_report(StateReader& reader) {
  StepReport report;
  report.step = reader.u64();
  report.evaluations = reader.u64();
  report.seconds = reader.f64();
  report.best = reader.f64();
  report.mean = reader.f64();
  report.idle = reader.u64();
  return report;
}

std::uint64_t read_stride(StateReader& reader) {
  const std::uint64_t stride = reader.u64();
  if (stride == 0) throw Error("the saved log has a stride of 0");
  return stride;
}

template <typename Row>
void expect_ascending(const std::vector<typename Thinned<Row>::Numbered>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].number <= rows[i - 1].number) throw Error("the rows of the saved log are out of order");
  }
}

}  // namespace

void SearchLog::add_gauges(const StepReport& report, const std::vector<NamedGauge>& gauges) {
  if (!gauges_.rows().empty() && gauges_.rows().back().number == report.step - 1) return;
  if (names_.empty()) {
    for (const NamedGauge& gauge : gauges) names_.push_back(gauge.name);
  }
  CHECK(names_.size() == gauges.size());
  GaugeRow row;
  row.report = report;
  for (std::size_t i = 0; i < gauges.size(); ++i) {
    DCHECK(gauges[i].name == names_[i]);
    row.values.push_back(gauges[i].value);
  }
  gauges_.add(report.step - 1, std::move(row));
}

std::vector<StepReport> SearchLog::steps() const {
  std::vector<StepReport> steps;
  for (const auto& [number, report] : steps_.rows()) steps.push_back(report);
  return steps;
}

std::vector<NamedGauge> SearchLog::last_gauges() const {
  std::vector<NamedGauge> gauges;
  if (gauges_.rows().empty()) return gauges;
  const std::vector<double>& values = gauges_.rows().back().row.values;
  for (std::size_t i = 0; i < values.size(); ++i) gauges.push_back({names_[i], values[i]});
  return gauges;
}

void SearchLog::save(StateWriter& writer) const {
  writer.u64(steps_.stride());
  writer.u64(steps_.rows().size());
  for (const auto& [number, report] : steps_.rows()) write_report(writer, report);
  writer.u64(names_.size());
  for (const std::string& name : names_) writer.text(name);
  writer.u64(gauges_.stride());
  writer.u64(gauges_.rows().size());
  for (const auto& [number, row] : gauges_.rows()) {
    write_report(writer, row.report);
    for (const double value : row.values) writer.f64(value);
  }
}

void SearchLog::load(StateReader& reader) {
  SearchLog loaded;
  const std::uint64_t stride = read_stride(reader);
  std::vector<Thinned<StepReport>::Numbered> steps(reader.u64_at_most(kMostSteps + 1, "steps of the log"));
  for (auto& [number, report] : steps) report = read_report(reader), number = report.step - 1;
  expect_ascending<StepReport>(steps);
  loaded.steps_.restore(stride, std::move(steps));
  const std::uint64_t names = reader.u64_at_most(kMostNames, "gauges");
  for (std::uint64_t i = 0; i < names; ++i) loaded.names_.push_back(reader.text());
  const std::uint64_t gauge_stride = read_stride(reader);
  std::vector<Thinned<GaugeRow>::Numbered> rows(reader.u64_at_most(kMostGaugeRows + 1, "rows of gauges"));
  for (auto& [number, row] : rows) {
    row.report = read_report(reader), number = row.report.step - 1;
    for (std::uint64_t i = 0; i < names; ++i) row.values.push_back(reader.f64());
  }
  expect_ascending<GaugeRow>(rows);
  loaded.gauges_.restore(gauge_stride, std::move(rows));
  *this = std::move(loaded);
}

}  // namespace espalier
