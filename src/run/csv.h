#pragma once
// Fields of CSV files (RFC 4180).

#include <optional>
#include <string>

namespace espalier {

/// A field of a CSV file: in quotes where it has to be.
std::string csv_field(const std::string& text);
/// A number that reads back as the same; empty where it is not finite.
std::string csv_number(double value);
std::string csv_number(const std::optional<double>& value);
/// A score as a share of the optimum; empty where there is no optimum above 0.
std::string csv_share(double score, double optimum);

}  // namespace espalier
