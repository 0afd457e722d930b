#include "run/json_number.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace espalier {

nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace espalier
