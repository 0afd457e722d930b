#pragma once
// The page of report.html: sources in src/run/report/, put into the program when it is built (cmake/embed.cmake).

#include <string_view>

namespace espalier {

extern const std::string_view kReportHtml;  // with places "{{name}}" to fill
extern const std::string_view kReportCss;
extern const std::string_view kReportJs;

}  // namespace espalier
