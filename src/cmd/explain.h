#pragma once
// What `espalier explain` prints.

#include <string>

#include "run/explain.h"

namespace espalier {

/// At most 100 columns wide.
std::string report_text(const GrammarReport& report, const ExplainRequest& request);
/// One document; the times stand apart in "seconds".
std::string report_json(const GrammarReport& report, const ExplainRequest& request);

}  // namespace espalier
