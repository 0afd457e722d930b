#include "run/report_diagnostics.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

SearchLog some_log() {
  SearchLog log;
  for (std::uint64_t step = 1; step <= 40; ++step) {
    const double x = static_cast<double>(step);
    const StepReport report = {step, step * 100, x / 10, x, x / 2};
    log.add(report);
    log.add_gauges(report, {{"distinct & more", 1 / x},
                            {"accepted draws, rung 0", 0.25},
                            {"accepted draws, rung 1", step > 20 ? 0.75 : kNone},
                            {"accepted jumps, rung 0", 0.125},
                            {"swaps, rung 0", 12},
                            {"swaps, rung 1", kNone},
                            {"never", kNone},
                            {"lonely, one", 3}});
  }
  return log;
}

TEST(ReportDiagnostics, DrawsGaugesAndTabulatesRates) {
  const std::string html = diagnostics_html(some_log(), {{"restarts", 1234567}, {"nothing", 0}});
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">distinct &amp; more</th><td><svg class=\"spark\""));
  EXPECT_THAT(html, HasSubstr("<td>0.025</td><td>0.025 &#8230; 1</td>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">lonely, one</th>"));
  EXPECT_THAT(html, Not(HasSubstr("never")));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">rung 0</th><th scope=\"col\">rung 1</th>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">accepted draws</th><td style=\"--rate:25%\">0.250</td>"
                              "<td style=\"--rate:75%\">0.750</td>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">accepted jumps</th><td style=\"--rate:12%\">0.125</td><td></td>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">swaps</th><td>12</td><td></td>"));
  EXPECT_THAT(html, HasSubstr("<dt>restarts</dt><dd>1,234,567</dd>"));
  EXPECT_THAT(html, Not(HasSubstr("nothing")));
}

TEST(ReportDiagnostics, CurvesRunFromEdgeToEdgeAndBreakWhereThereIsNoNumber) {
  SearchLog log;
  const double values[] = {0, 1, kNone, 0.5, 1};
  for (std::uint64_t step = 1; step <= 5; ++step) {
    log.add_gauges({step, step * 10, 0, 0, 0}, {{"one", values[step - 1]}});
  }
  EXPECT_THAT(diagnostics_html(log, {}), HasSubstr("<path d=\"M2.0 28.0L56.0 2.0M164.0 15.0L218.0 2.0\"></path>"));
}

TEST(ReportDiagnostics, SaysSoWhereThereIsNothingYet) {
  EXPECT_THAT(diagnostics_html(SearchLog(), {}), HasSubstr("when the search has ended"));
}

}  // namespace
}  // namespace espalier
