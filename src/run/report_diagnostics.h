#pragma once
// The report's section on how the engine did: its gauges as curves, rates by kind and rung as tables, its counts.

#include <string>
#include <vector>

#include "run/search_log.h"
#include "search/engine.h"

namespace espalier {

/// HTML. Gauges that are named "WHAT, WHERE" share a table with a row per WHAT and a column per WHERE, if others are of
/// the same or in the same place; of the rest the course is drawn. What was never a number, and counts of 0, are left out.
std::string diagnostics_html(const SearchLog& log, const std::vector<NamedCount>& counts);

/// "a, b" to ("a", "b"); what follows is empty where there is no comma.
struct GaugeName {
  std::string what, where;
};
GaugeName split_gauge_name(const std::string& name);

}  // namespace espalier
