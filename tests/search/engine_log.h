#pragma once
// What an engine leaves behind, as text to compare, and its counts by name.

#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "search/engine.h"

namespace espalier::testing {

/// Everything that each of the next `steps` steps leaves behind, a line each.
inline std::string log_of(Engine& engine, int steps) {
  std::ostringstream log;
  log.precision(17);
  for (int i = 0; i < steps; ++i) {
    engine.step();
    log << engine.steps() << ' ' << engine.evaluations() << ' ' << engine.best().score;
    for (const Individual& individual : engine.population()) log << ' ' << hash(individual.derivation);
    for (const NamedCount& count : engine.diagnostics()) log << ' ' << count.value;
    log << '\n';
  }
  return log.str();
}

inline std::uint64_t count_of(const Engine& engine, const std::string& name) {
  for (const NamedCount& count : engine.diagnostics()) {
    if (count.name == name) return count.value;
  }
  ADD_FAILURE() << "no count named " << name;
  return 0;
}

}  // namespace espalier::testing
