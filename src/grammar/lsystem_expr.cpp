// Expressions of L-systems: their values, and their text in our language.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "grammar/lsystem.h"

namespace espalier::lsystem {
namespace {

struct Style {
  std::string_view text;
  int strength;
};

/// By Op: how our language writes it, and how tightly it binds.
constexpr std::array<Style, 17> kStyles = {{{"", 9},    {"", 9},   {"-", 7},  {"not ", 3}, {"or", 1}, {"and", 2},
                                            {"<", 4},   {"<=", 4}, {">", 4},  {">=", 4},   {"==", 4}, {"!=", 4},
                                            {"+", 5},   {"-", 5},  {"*", 6},  {"/", 6},    {"^", 8}}};

const Style& style(Op op) { return kStyles[static_cast<std::size_t>(op)]; }

double apply(Op op, double a, double b) {
  switch (op) {
    case Op::logical_or: return a != 0 || b != 0;
    case Op::logical_and: return a != 0 && b != 0;
    case Op::less: return a < b;
    case Op::less_equal: return a <= b;
    case Op::greater: return a > b;
    case Op::greater_equal: return a >= b;
    case Op::equal: return a == b;
    case Op::not_equal: return a != b;
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return a * b;
    case Op::divide: return a / b;
    default: return std::pow(a, b);
  }
}

}  // namespace

std::optional<double> evaluate(const Expr& expr, const Values& value_of) {
  if (expr.op == Op::number) return expr.value;
  if (expr.op == Op::name) return value_of(expr.name);
  const std::optional<double> a = evaluate(expr.children[0], value_of);
  if (!a) return std::nullopt;
  if (expr.op == Op::negate) return -*a;
  if (expr.op == Op::logical_not) return *a == 0;
  const std::optional<double> b = evaluate(expr.children[1], value_of);
  if (!b) return std::nullopt;
  const double result = apply(expr.op, *a, *b);
  return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

std::string spell(double number) { return fmt::format("{}", number); }

std::string spell(const Expr& expr, const Spelling& spell_name) {
  if (expr.op == Op::number) return spell(expr.value);
  if (expr.op == Op::name) return spell_name(expr.name);
  const Style& mine = style(expr.op);
  const auto child = [&](std::size_t i, bool tighter) {
    const int theirs = style(expr.children[i].op).strength;
    const std::string text = spell(expr.children[i], spell_name);
    return theirs < mine.strength || (tighter && theirs == mine.strength) ? "(" + text + ")" : text;
  };
  if (expr.children.size() == 1) return std::string(mine.text) + child(0, true);
  const bool comparison = mine.strength == 4;
  return fmt::format("{} {} {}", child(0, comparison || expr.op == Op::power), mine.text, child(1, true));
}

bool reads(const Expr& expr, const std::string& name) {
  if (expr.op == Op::name) return expr.name == name;
  return std::any_of(expr.children.begin(), expr.children.end(), [&](const Expr& c) { return reads(c, name); });
}

}  // namespace espalier::lsystem
