// Ranges of draws, where they are constant.

#include <cmath>

#include <fmt/core.h>

#include "grammar/static_checks.h"

namespace espalier {

using ast::Expr;

void StaticChecks::draw(const Expr& call, const StaticScope& scope) {
  if (call.name == "uniform") return uniform(call, scope);
  if (call.name == "normal") return normal(call, scope);
  if (call.name == "loguniform") return loguniform(call, scope);
  if (call.name == "integer") return integer(call, scope);
  if (call.name == "chance") return chance(call, scope);
  if (call.name == "pick") return pick(call, scope);
}

void StaticChecks::uniform(const Expr& call, const StaticScope& scope) {
  const Value a = value(*call.args[0].value, scope), b = value(*call.args[1].value, scope);
  if (!a || !b || a->kind != b->kind) return;
  const int components = components_of(a->kind);
  int empty = 0;
  for (int i = 0; i < components; ++i)
    empty += a->numbers[static_cast<std::size_t>(i)] == b->numbers[static_cast<std::size_t>(i)];
  if (empty == components)
    error("E0505", call, fmt::format("the range of this draw is empty: {} to {}", describe(*a), describe(*b)),
          "write a `let`");
  else if (empty > 0)
    warning("W0505", call, fmt::format("a component of this draw never varies: {} to {}", describe(*a), describe(*b)));
}

void StaticChecks::normal(const Expr& call, const StaticScope& scope) {
  const Value deviation = value(*call.args[1].value, scope);
  const Value low = value(*call.args[2].value, scope), high = value(*call.args[3].value, scope);
  if (deviation && !(deviation->scalar() > 0))
    error("E0506", *call.args[1].value,
          fmt::format("the deviation of `normal` must be > 0, got {}", describe(*deviation)),
          "`normal(mean, deviation, low, high)`");
  if (low && high && !(low->scalar() < high->scalar()))
    error("E0505", call, fmt::format("the range of this draw is empty: {} to {}", describe(*low), describe(*high)),
          "`normal(mean, deviation, low, high)`");
}

void StaticChecks::loguniform(const Expr& call, const StaticScope& scope) {
  const Value a = value(*call.args[0].value, scope), b = value(*call.args[1].value, scope);
  for (const auto& [bound, arg] : {std::pair(&a, &call.args[0]), std::pair(&b, &call.args[1])})
    if (*bound && !((*bound)->scalar() > 0))
      error("E0507", *arg->value, fmt::format("the range of `loguniform` must lie above 0, got {}", describe(**bound)));
  if (a && b && *a == *b)
    error("E0505", call, fmt::format("the range of this draw is empty: {} to {}", describe(*a), describe(*b)),
          "write a `let`");
}

void StaticChecks::integer(const Expr& call, const StaticScope& scope) {
  constexpr double kMostValues = 1 << 20;  // a slider's plateaus stay wide enough for 32-bit quantiles
  const Value a = value(*call.args[0].value, scope), b = value(*call.args[1].value, scope);
  for (const auto& [bound, arg] : {std::pair(&a, &call.args[0]), std::pair(&b, &call.args[1])})
    if (*bound && (*bound)->scalar() != std::floor((*bound)->scalar()))
      error("E0508", *arg->value, fmt::format("`integer` goes between whole numbers, got {}", describe(**bound)));
  if (!a || !b) return;
  if (!(a->scalar() < b->scalar()))
    error("E0505", call, fmt::format("the range of this draw is empty: {} to {}", describe(*a), describe(*b)),
          "`integer(low, high)` has at least two values, both ends included");
  else if (b->scalar() - a->scalar() >= kMostValues)
    error("E0508", call,
          fmt::format("`integer` has at most {} values, here {:.0f}", kMostValues, b->scalar() - a->scalar() + 1));
}

void StaticChecks::chance(const Expr& call, const StaticScope& scope) {
  const Value p = value(*call.args[0].value, scope);
  if (p && !(p->scalar() >= 0 && p->scalar() <= 1))
    error("E0509", *call.args[0].value, fmt::format("a chance must be in 0..1, got {}", describe(*p)));
}

void StaticChecks::pick(const Expr& call, const StaticScope& scope) {
  for (const ast::Arg& arg : call.args) {
    if (!arg.label) continue;
    const Value weight = value(*arg.label, scope);
    if (!weight) error("E0510", *arg.label, "a weight of `pick` must be constant");
    else if (!(weight->scalar() > 0))
      error("E0510", *arg.label, fmt::format("a weight must be > 0, got {}", describe(*weight)));
  }
}

}  // namespace espalier
