#pragma once
// Numbers in JSON files.

#include <nlohmann/json_fwd.hpp>

namespace espalier {

/// JSON has no infinity and nothing that is not a number: null stands for them.
nlohmann::ordered_json number_or_null(double value);

}  // namespace espalier
