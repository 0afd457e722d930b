#include "run/csv.h"

#include <cmath>

#include <fmt/format.h>

namespace espalier {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_number(const std::optional<double>& value) { return value ? csv_number(*value) : ""; }

std::string csv_share(double score, double optimum) { return csv_number(optimum > 0 ? score / optimum : NAN); }

}  // namespace espalier
