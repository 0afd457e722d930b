#pragma once
// What an engine leaves behind, as text to compare, and its counts by name.

#include <initializer_list>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "search/engine.h"

namespace espalier::testing {

/// All gauges, names and values.
inline std::string gauges_of(const Engine& engine) {
  std::ostringstream text;
  text.precision(17);
  for (const NamedGauge& gauge : engine.gauges()) text << gauge.name << ' ' << gauge.value << ' ';
  return text.str();
}

inline double gauge_of(const Engine& engine, const std::string& name) {
  for (const NamedGauge& gauge : engine.gauges()) {
    if (gauge.name == name) return gauge.value;
  }
  ADD_FAILURE() << "no gauge named " << name;
  return 0;
}

/// Everything that each of the next `steps` steps leaves behind, a line each.
inline std::string log_of(Engine& engine, int steps) {
  std::ostringstream log;
  log.precision(17);
  for (int i = 0; i < steps; ++i) {
    engine.step();
    log << engine.steps() << ' ' << engine.evaluations() << ' ' << engine.best().score;
    for (const Individual& individual : engine.population()) log << ' ' << hash(individual.derivation);
    for (const NamedCount& count : engine.diagnostics()) log << ' ' << count.value;
    log << ' ' << gauges_of(engine);
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

/// `make()` gives something with an engine, each time anew. An engine that loads what another one saved after so many
/// steps goes on as that one would have.
template <typename Make>
void expect_saved_states_go_on(Make make, std::initializer_list<int> befores, int after) {
  for (const int before : befores) {
    auto whole = make(), first = make(), second = make();
    log_of(whole->engine, before);
    log_of(first->engine, before);
    std::stringstream state;
    first->engine.save(state);
    second->engine.load(state);
    EXPECT_EQ(gauges_of(second->engine), gauges_of(first->engine)) << "after " << before;
    EXPECT_EQ(log_of(second->engine, after), log_of(whole->engine, after)) << "after " << before;
  }
}

/// States that are cut short are refused, and change nothing; so are those that are meant for `other`.
template <typename Make>
void expect_foreign_states_refused(Make make, Engine& other, int before) {
  auto saved = make(), target = make(), fresh = make();
  log_of(saved->engine, before);
  std::stringstream state;
  saved->engine.save(state);
  const std::string text = state.str();
  EXPECT_THROW(other.load(state), Error);
  for (std::size_t n = 0; n < text.size(); n += 1 + text.size() / 50) {
    std::stringstream cut(text.substr(0, n));
    EXPECT_THROW(target->engine.load(cut), Error) << n;
  }
  EXPECT_EQ(log_of(target->engine, 5), log_of(fresh->engine, 5));
}

}  // namespace espalier::testing
