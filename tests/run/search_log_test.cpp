#include "run/search_log.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error.h"

namespace espalier {
namespace {

TEST(Thinned, KeepsAFixedNumberOfRowsAndAlwaysTheLast) {
  for (std::uint64_t end = 1; end < 200; ++end) {
    Thinned<std::uint64_t> series(8);
    for (std::uint64_t i = 0; i < end; ++i) series.add(i, i * i);
    const auto& rows = series.rows();
    ASSERT_LE(rows.size(), 9u);
    EXPECT_EQ(rows.front().number, 0u);
    EXPECT_EQ(rows.back().number, end - 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].row, rows[i].number * rows[i].number);
      if (i + 1 < rows.size()) {
        EXPECT_EQ(rows[i].number, i * series.stride()) << end;
      }
    }
    EXPECT_GE(rows.size(), std::min<std::uint64_t>(end, 5)) << "half of them, and no fewer";
  }
}

TEST(Thinned, AllRowsOfAShortSeries) {
  Thinned<int> series(100);
  for (int i = 0; i < 100; ++i) series.add(static_cast<std::uint64_t>(i), i);
  EXPECT_EQ(series.rows().size(), 100u);
  EXPECT_EQ(series.stride(), 1u);
}

StepReport report_of(std::uint64_t step) {
  const double x = static_cast<double>(step);
  return {step, step * 10, x / 7, x / 3, -x};
}

SearchLog log_of_steps(std::uint64_t steps) {
  SearchLog log;
  for (std::uint64_t step = 1; step <= steps; ++step) {
    log.add(report_of(step));
    if (log.wants_gauges(step)) log.add_gauges(report_of(step), {{"a", 1.0 / static_cast<double>(step)}, {"b", 2}});
  }
  return log;
}

std::string text_of(const SearchLog& log) {
  std::ostringstream out;
  StateWriter writer(out);
  log.save(writer);
  return out.str();
}

TEST(SearchLog, IsBounded) {
  const SearchLog log = log_of_steps(100'000);
  EXPECT_LE(log.steps().size(), SearchLog::kMostSteps + 1);
  EXPECT_LE(log.gauge_rows().size(), SearchLog::kMostGaugeRows + 1);
  EXPECT_EQ(log.steps().front().step, 1u);
  EXPECT_EQ(log.steps().back().step, 100'000u);
  EXPECT_EQ(log.gauge_names(), (std::vector<std::string>{"a", "b"}));
}

TEST(SearchLog, GoesOnAfterLoadingAsIfItHadNotBeenSaved) {
  for (const std::uint64_t steps : {1u, 9u, 3000u, 20'000u}) {
    SearchLog log = log_of_steps(steps), loaded = log_of_steps(5);
    std::istringstream in(text_of(log));
    StateReader reader(in);
    loaded.load(reader);
    for (std::uint64_t step = steps + 1; step < steps + 9000; ++step) {
      log.add(report_of(step)), loaded.add(report_of(step));
      EXPECT_EQ(log.wants_gauges(step), loaded.wants_gauges(step));
    }
    EXPECT_EQ(text_of(log), text_of(loaded));
  }
}

TEST(SearchLog, DamagedStreamsChangeNothing) {
  SearchLog log = log_of_steps(20);
  const std::string whole = text_of(log_of_steps(50)), before = text_of(log);
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    std::istringstream in(whole.substr(0, length));
    StateReader reader(in);
    EXPECT_THROW(log.load(reader), Error) << length;
  }
  EXPECT_EQ(text_of(log), before);
}

}  // namespace
}  // namespace espalier
