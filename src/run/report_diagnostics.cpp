#include "run/report_diagnostics.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "run/report_text.h"

namespace espalier {
namespace {

constexpr double kWide = 220, kTall = 30;  // of a curve, in pixels
constexpr double kPad = 2;                 // so that lines at the rim are not cut
constexpr std::size_t kMostPoints = 220;

std::string figure_of(double value) {
  if (!std::isfinite(value)) return "&#8211;";
  return readable_number(value);
}

struct Range {
  double low = 0, high = 0;
  bool any = false;

  void take(double value) {
    if (!std::isfinite(value)) return;
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
};

using Rows = std::vector<Thinned<GaugeRow>::Numbered>;

Range range_of(const Rows& rows, std::size_t gauge) {
  Range range;
  for (const auto& [number, row] : rows) range.take(row.values[gauge]);
  return range;
}

/// Over the evaluations, from edge to edge; broken where there is no number.
std::string curve(const Rows& rows, std::size_t gauge, const Range& range) {
  const double first = static_cast<double>(rows.front().row.report.evaluations);
  const double last = static_cast<double>(rows.back().row.report.evaluations);
  const std::size_t stride = rows.size() / kMostPoints + 1;
  std::string path;
  bool drawing = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i % stride != 0 && i + 1 != rows.size()) continue;
    const double value = rows[i].row.values[gauge];
    if (!std::isfinite(value)) {
      drawing = false;
      continue;
    }
    const double across = last > first ? (static_cast<double>(rows[i].row.report.evaluations) - first) / (last - first) : 1;
    const double up = range.high > range.low ? (value - range.low) / (range.high - range.low) : 0.5;
    path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", kPad + across * (kWide - 2 * kPad),
                        kTall - kPad - up * (kTall - 2 * kPad));
    drawing = true;
  }
  return fmt::format("<svg class=\"spark\" viewBox=\"0 0 {:g} {:g}\" aria-hidden=\"true\"><path d=\"{}\"></path></svg>", kWide,
                     kTall, path);
}

std::string curve_row(const SearchLog& log, std::size_t gauge) {
  const Rows& rows = log.gauge_rows();
  const Range range = range_of(rows, gauge);
  if (!range.any) return "";
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{} &#8230; {}</td></tr>\n",
                     escape_html(log.gauge_names()[gauge]), curve(rows, gauge, range),
                     figure_of(rows.back().row.values[gauge]), figure_of(range.low), figure_of(range.high));
}

/// Rates are tinted by what they are.
std::string cell(double value) {
  const bool rate = std::isfinite(value) && value >= 0 && value <= 1;
  const std::string text = rate ? fmt::format("{:.3f}", value) : figure_of(value);
  if (!rate) return "<td>" + text + "</td>";
  return fmt::format("<td style=\"--rate:{:.0f}%\">{}</td>", 100 * value, text);
}

/// Gauges that stand together: what, where, which.
struct Matrix {
  std::vector<std::string> whats, wheres;
  std::map<std::pair<std::string, std::string>, std::size_t> gauges;

  void add(const GaugeName& name, std::size_t gauge) {
    if (std::find(whats.begin(), whats.end(), name.what) == whats.end()) whats.push_back(name.what);
    if (std::find(wheres.begin(), wheres.end(), name.where) == wheres.end()) wheres.push_back(name.where);
    gauges[{name.what, name.where}] = gauge;
  }
};

bool has_number(const SearchLog& log, std::size_t gauge) {
  return std::isfinite(log.gauge_rows().back().row.values[gauge]);
}

std::string matrix_html(const SearchLog& log, const Matrix& matrix) {
  std::string html = "<div class=\"scroll\"><table class=\"matrix\">\n<caption>Of the last moment</caption>\n"
                     "<thead><tr><td></td>";
  for (const std::string& where : matrix.wheres) html += "<th scope=\"col\">" + escape_html(where) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const std::string& what : matrix.whats) {
    html += "<tr><th scope=\"row\">" + escape_html(what) + "</th>";
    for (const std::string& where : matrix.wheres) {
      const auto found = matrix.gauges.find({what, where});
      html += found == matrix.gauges.end() ? "<td></td>" : cell(log.gauge_rows().back().row.values[found->second]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string counts_html(const std::vector<NamedCount>& counts) {
  std::string items;
  for (const NamedCount& count : counts) {
    if (count.value == 0) continue;
    items += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(count.name),
                         readable_number(static_cast<double>(count.value)));
  }
  if (items.empty()) return "";
  return "<details>\n<summary>What it counted</summary>\n<dl class=\"counts\">\n" + items + "</dl>\n</details>\n";
}

}  // namespace

GaugeName split_gauge_name(const std::string& name) {
  const std::size_t comma = name.rfind(", ");
  return comma == std::string::npos ? GaugeName{name, ""} : GaugeName{name.substr(0, comma), name.substr(comma + 2)};
}

std::string diagnostics_html(const SearchLog& log, const std::vector<NamedCount>& counts) {
  if (log.gauge_rows().empty()) return "<p>Told when the search has ended.</p>\n";
  std::map<std::string, int> of_what, at_where;
  for (const std::string& full : log.gauge_names()) {
    const GaugeName name = split_gauge_name(full);
    ++of_what[name.what], ++at_where[name.where];
  }
  Matrix matrix;
  std::string curves;
  for (std::size_t i = 0; i < log.gauge_names().size(); ++i) {
    const GaugeName name = split_gauge_name(log.gauge_names()[i]);
    if (name.where.empty() || (of_what[name.what] < 2 && at_where[name.where] < 2)) {
      curves += curve_row(log, i);
    } else if (has_number(log, i)) {
      matrix.add(name, i);
    }
  }
  std::string html = "<div class=\"scroll\"><table class=\"gauges\">\n<thead><tr><th scope=\"col\">gauge</th><th scope=\"col\">over the "
                     "evaluations</th><th scope=\"col\">at the end</th><th scope=\"col\">range</th></tr></thead>\n<tbody>\n" +
                     curves + "</tbody>\n</table></div>\n";
  if (!matrix.whats.empty()) html += matrix_html(log, matrix);
  return html + counts_html(counts);
}

}  // namespace espalier
