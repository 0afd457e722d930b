#pragma once
// A slow, obviously right L-system: rewrites strings of modules and walks them with a turtle, in doubles. Knows nothing
// of grammars, genes or leaps; uses only the parsed productions.

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "grammar/lsystem.h"

namespace espalier::reference {

struct Symbol {
  std::string letter;
  std::vector<double> args;
};
using Word = std::vector<Symbol>;

struct Line {
  glm::dvec3 from, to;
};

/// Which of the productions that apply to a symbol is taken.
using Choose = std::function<std::size_t(const std::vector<std::size_t>& productions)>;

class LSystem {
 public:
  explicit LSystem(const lsystem::System& system) : system_(system) {}

  Word axiom() const { return word(system_.axiom, {}, {}); }

  /// One step for the whole word.
  Word rewrite(const Word& before) const {
    Word after;
    for (const Symbol& s : before) append(after, successor(s, first));
    return after;
  }
  /// All steps for one symbol after the other, so that choices are asked for in the order of the derivation tree.
  Word rewrite_deep(const Word& before, int steps, const Choose& choose) const {
    if (steps == 0) return before;
    Word after;
    for (const Symbol& s : before) {
      if (applying(s).empty()) after.push_back(s);
      else append(after, rewrite_deep(successor(s, choose), steps - 1, choose));
    }
    return after;
  }

  std::vector<Line> walk(const Word& word) const {
    struct State {
      glm::dvec3 at{0};
      glm::dmat3 frame{1};  // columns: right, heading, up
    };
    State state;
    std::vector<State> stack;
    std::vector<Line> lines;
    for (const Symbol& s : word) {
      const char c = s.letter[0];
      const double degrees = s.args.empty() ? system_.angle : s.args[0];
      const double length = s.args.empty() ? system_.step : s.args[0];
      const bool draws = system_.draw.find(c) != std::string::npos, moves = system_.move.find(c) != std::string::npos;
      if (draws || moves) {
        const glm::dvec3 to = state.at + length * state.frame[1];
        if (draws) lines.push_back({state.at, to});
        state.at = to;
      }
      // The book's words: + left, & down, \ left wing down; left is -x, up is +z.
      if (c == '+') turn(state.frame, 1, 0, -degrees);
      if (c == '-') turn(state.frame, 1, 0, degrees);
      if (c == '&') turn(state.frame, 1, 2, -degrees);
      if (c == '^') turn(state.frame, 1, 2, degrees);
      if (c == '\\') turn(state.frame, 0, 2, degrees);
      if (c == '/') turn(state.frame, 0, 2, -degrees);
      if (c == '|') turn(state.frame, 1, 0, 180);
      if (c == '[') stack.push_back(state);
      if (c == ']') state = stack.back(), stack.pop_back();
    }
    return lines;
  }

  static std::size_t first(const std::vector<std::size_t>& productions) { return productions[0]; }

 private:
  /// Turns direction `a` towards direction `b`.
  static void turn(glm::dmat3& frame, int a, int b, double degrees) {
    const double t = degrees * std::numbers::pi / 180;
    const glm::dvec3 u = frame[a], v = frame[b];
    frame[a] = std::cos(t) * u + std::sin(t) * v;
    frame[b] = std::cos(t) * v - std::sin(t) * u;
  }
  double value(const lsystem::Expr& e, const std::vector<std::string>& names, const std::vector<double>& values) const {
    return *lsystem::evaluate(e, [&](const std::string& name) -> std::optional<double> {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) return values[i];
      for (const auto& c : system_.constants)
        if (c.name == name) return c.number;
      return std::nullopt;
    });
  }
  Word word(const std::vector<lsystem::Module>& modules, const std::vector<std::string>& names,
            const std::vector<double>& values) const {
    Word result;
    for (const auto& m : modules) {
      result.push_back({m.symbol, {}});
      for (const auto& arg : m.args) result.back().args.push_back(value(arg, names, values));
    }
    return result;
  }
  std::vector<std::size_t> applying(const Symbol& s) const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < system_.productions.size(); ++i) {
      const auto& p = system_.productions[i];
      if (p.symbol != s.letter || p.params.size() != s.args.size()) continue;
      if (!p.guard || value(*p.guard, p.params, s.args) != 0) result.push_back(i);
    }
    return result;
  }
  Word successor(const Symbol& s, const Choose& choose) const {
    const std::vector<std::size_t> productions = applying(s);
    if (productions.empty()) return {s};
    const auto& p = system_.productions[productions.size() > 1 ? choose(productions) : productions[0]];
    return word(p.successor, p.params, s.args);
  }
  static void append(Word& to, const Word& more) { to.insert(to.end(), more.begin(), more.end()); }

  const lsystem::System& system_;
};

}  // namespace espalier::reference
