#pragma once
// The pages of compare.html and sweep.html: sources in src/run/report/, put into the program when it is built.

#include <string_view>

namespace espalier {

extern const std::string_view kCompareHtml, kSweepHtml;  // with places "{{name}}" to fill
extern const std::string_view kContestCss;               // after that of reports
extern const std::string_view kContestJs;

}  // namespace espalier
