#pragma once
// Explanations of scores, as JSON and as lines for people.

#include <string>

#include "score/target.h"

namespace espalier {

/// {"score", "optimum", "percent", "rejected", "words", "targets": [{"name", "weight", "score", "optimum", "percent",
/// "rejected", "words", "terms": [{"name", "weight", "count", "of", "unit", "value"}]}]}; a rejected score is null.
std::string explanation_json(const Explanation& explanation);

/// Score, optimum, percent and words, then a line per term. Ends with a newline.
std::string explanation_text(const Explanation& explanation);

}  // namespace espalier
