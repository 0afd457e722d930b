#include "grammar/static_value.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "base/math.h"
#include "grammar/checked.h"
#include "grammar/kind_rules.h"
#include "grammar/words.h"

namespace espalier {
namespace {

using ast::Expr;
using ast::ExprKind;
using ast::Operator;
using Result = std::optional<StaticValue>;

// The checker refuses functions that call themselves; this only keeps a faulty tree from running away.
constexpr int kDeepestCalls = 70;

// Transcendental functions in single precision, like the run time's: their bits do not depend on the CPU.
double apply_function(std::string_view name, double a, double b, double c) {
  const auto x = static_cast<float>(a), y = static_cast<float>(b);
  if (name == "abs") return std::fabs(a);
  if (name == "floor") return std::floor(a);
  if (name == "ceil") return std::ceil(a);
  if (name == "round") return std::floor(a + 0.5);
  if (name == "sqrt") return std::sqrt(a);
  if (name == "exp") return exponential(x);
  if (name == "log") return std::log(x);
  if (name == "sin") return sine(x);
  if (name == "cos") return cosine(x);
  if (name == "tan") return tangent(x);
  if (name == "asin") return std::asin(x);
  if (name == "acos") return std::acos(x);
  if (name == "atan2") return std::atan2(x, y);
  if (name == "min") return std::min(a, b);
  if (name == "max") return std::max(a, b);
  if (name == "clamp") return std::min(std::max(a, b), c);
  if (name == "mix") return a + (b - a) * c;
  if (name == "smooth") {
    const double t = std::min(std::max((c - a) / (b - a), 0.0), 1.0);
    return t * t * (3 - 2 * t);
  }
  return NAN;
}

double apply_operator(Operator op, double a, double b) {
  switch (op) {
    case Operator::add: return a + b;
    case Operator::subtract: return a - b;
    case Operator::multiply: return a * b;
    case Operator::divide: return a / b;
    case Operator::modulo: return a - b * std::floor(a / b);
    case Operator::power: return power(static_cast<float>(a), static_cast<float>(b));
    case Operator::less: return a < b;
    case Operator::less_equal: return a <= b;
    case Operator::greater: return a > b;
    case Operator::greater_equal: return a >= b;
    case Operator::equal: return a == b;
    case Operator::not_equal: return a != b;
    case Operator::logical_and: return a != 0 && b != 0;
    case Operator::logical_or: return a != 0 || b != 0;
    default: return NAN;
  }
}

double component(const StaticValue& value, int i) { return value.numbers[value.kind == Kind::vector ? i : 0]; }

class Evaluator {
 public:
  Evaluator(const StaticScope& scope, Diagnostics* diagnostics, int calls = 0)
      : scope_(scope), diagnostics_(diagnostics), calls_(calls) {}

  Result evaluate(const Expr& expr) {
    switch (expr.kind) {
      case ExprKind::number: return literal_value(expr);
      case ExprKind::text: return StaticValue{Kind::text, {}, expr.name};
      case ExprKind::boolean: return StaticValue::boolean(expr.value != 0);
      case ExprKind::name: return name(expr);
      case ExprKind::call: return call(expr);
      case ExprKind::vector: return vector(expr);
      case ExprKind::unary: return unary(expr);
      case ExprKind::binary: return binary(expr);
      case ExprKind::ternary: return ternary(expr);
      case ExprKind::member: return member(expr);
    }
    return std::nullopt;
  }

 private:
  Result fault(std::string code, const Expr& expr, std::string message) {
    if (diagnostics_) diagnostics_->error(std::move(code), expr.span, std::move(message));
    return std::nullopt;
  }

  Result finite(const Expr& expr, const StaticValue& value) {
    for (const double number : value.numbers)
      if (!std::isfinite(number)) return fault("E0502", expr, "the value of this is not a finite number");
    return value;
  }

  Result name(const Expr& expr) {
    if (const auto local = scope_.locals.find(expr.name); local != scope_.locals.end()) return local->second;
    const CheckedGrammar& grammar = scope_.grammar;
    if (const auto found = grammar.constants.find(expr.name); found != grammar.constants.end()) return found->second;
    if (const auto found = grammar.attributes.find(expr.name); found != grammar.attributes.end())
      return scope_.attributes ? Result(found->second.value) : std::nullopt;
    if (const Builtin* builtin = find_builtin(expr.name); builtin && builtin->sort == BuiltinSort::primitive)
      return StaticValue{Kind::mesh, {}, expr.name};
    if (grammar.find(expr.name, ast::DeclKind::mesh)) return StaticValue{Kind::mesh, {}, expr.name};
    if (grammar.find(expr.name, ast::DeclKind::material)) return StaticValue{Kind::material, {}, expr.name};
    return std::nullopt;
  }

  Result vector(const Expr& expr) {
    StaticValue value{Kind::vector, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Result part = evaluate(*expr.children[i]);
      if (!part || part->kind != Kind::number) return std::nullopt;
      value.numbers[i] = part->scalar();
    }
    return value;
  }

  Result unary(const Expr& expr) {
    Result value = evaluate(*expr.children[0]);
    if (!value || !kind_of_unary(expr.op, value->kind)) return std::nullopt;
    if (expr.op == Operator::logical_not) return StaticValue::boolean(!value->truth());
    for (double& number : value->numbers) number = -number;
    return value;
  }

  Result binary(const Expr& expr) {
    const Result a = evaluate(*expr.children[0]);
    const Result b = evaluate(*expr.children[1]);
    if (!a || !b) return std::nullopt;
    const std::optional<Kind> kind = kind_of_binary(expr.op, a->kind, b->kind);
    if (!kind) return std::nullopt;
    StaticValue value{*kind, {}, {}};
    for (int i = 0; i < components_of(*kind); ++i) {
      const double divisor = component(*b, i);
      if ((expr.op == Operator::divide || expr.op == Operator::modulo) && divisor == 0)
        return fault("E0501", expr, "division by zero");
      value.numbers[i] = apply_operator(expr.op, component(*a, i), divisor);
    }
    return finite(expr, value);
  }

  /// Only the value that is chosen need be static.
  Result ternary(const Expr& expr) {
    const Result condition = evaluate(*expr.children[0]);
    if (!condition || condition->kind != Kind::boolean) return std::nullopt;
    return evaluate(*expr.children[condition->truth() ? 1 : 2]);
  }

  Result member(const Expr& expr) {
    const Result value = evaluate(*expr.children[0]);
    if (!value || value->kind != Kind::vector) return std::nullopt;
    return StaticValue::number(value->numbers[static_cast<std::size_t>(expr.axis)]);
  }

  Result call(const Expr& expr) {
    if (expr.name == "depth") {
      if (expr.args.size() != 1 || expr.args[0].value->kind != ExprKind::name) return std::nullopt;
      const auto local = scope_.locals.find(fmt::format("depth({})", expr.args[0].value->name));
      return local == scope_.locals.end() ? std::nullopt : Result(local->second);
    }
    std::vector<StaticValue> arguments;
    for (const ast::Arg& arg : expr.args) {
      const Result value = evaluate(*arg.value);
      if (!value) return std::nullopt;
      arguments.push_back(*value);
    }
    if (const ast::Decl* function = scope_.grammar.find(expr.name, ast::DeclKind::function))
      return call_function(*function, arguments);
    return call_builtin(expr, arguments);
  }

  Result call_function(const ast::Decl& function, const std::vector<StaticValue>& arguments) {
    if (arguments.size() != function.params.size() || calls_ >= kDeepestCalls) return std::nullopt;
    StaticScope inner{scope_.grammar, scope_.attributes, {}};
    for (std::size_t i = 0; i < arguments.size(); ++i) inner.locals[function.params[i].name] = arguments[i];
    return Evaluator(inner, diagnostics_, calls_ + 1).evaluate(*function.value);
  }

  Result call_builtin(const Expr& expr, const std::vector<StaticValue>& arguments) {
    std::vector<Kind> kinds;
    for (const StaticValue& argument : arguments) kinds.push_back(argument.kind);
    const std::optional<Kind> kind = kind_of_function(expr.name, kinds);
    if (!kind || *kind == Kind::material) return std::nullopt;
    if (kinds[0] == Kind::vector || *kind == Kind::vector)
      return finite(expr, vector_function(expr.name, *kind, arguments));
    const auto argument = [&](std::size_t i) { return i < arguments.size() ? arguments[i].scalar() : 0.0; };
    return finite(expr, {*kind, {apply_function(expr.name, argument(0), argument(1), argument(2)), 0, 0}, {}});
  }

  static StaticValue vector_function(std::string_view name, Kind kind, const std::vector<StaticValue>& arguments) {
    const auto& a = arguments[0].numbers;
    const auto dot = [](const auto& u, const auto& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
    if (name == "vec") return StaticValue::vector(a[0], a[0], a[0]);
    if (name == "length") return StaticValue::number(std::sqrt(dot(a, a)));
    if (name == "dot") return StaticValue::number(dot(a, arguments[1].numbers));
    StaticValue value{kind, a, {}};
    if (name == "normalize")
      for (double& number : value.numbers) number /= std::sqrt(dot(a, a));
    if (name != "cross" && name != "mix") return value;
    const auto& b = arguments[1].numbers;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      value.numbers[i] = name == "cross" ? a[j] * b[k] - a[k] * b[j] : a[i] + (b[i] - a[i]) * arguments[2].scalar();
    }
    return value;
  }

  const StaticScope& scope_;
  Diagnostics* diagnostics_;
  int calls_;
};

}  // namespace

std::string describe(const StaticValue& value) {
  const auto& n = value.numbers;
  switch (value.kind) {
    case Kind::number: return fmt::format("{:.9g}", n[0]);
    case Kind::angle: return fmt::format("{:.7g}deg", n[0] * (180 / kPi));
    case Kind::vector: return fmt::format("({:.9g}, {:.9g}, {:.9g})", n[0], n[1], n[2]);
    case Kind::boolean: return n[0] != 0 ? "true" : "false";
    case Kind::text: return fmt::format("\"{}\"", value.text);
    case Kind::mesh:
    case Kind::material:
    case Kind::texture: break;
  }
  return value.text;
}

StaticValue literal_value(const ast::Expr& number) {
  switch (number.unit) {
    case ast::Unit::degrees: return StaticValue::angle(number.value * (kPi / 180));
    case ast::Unit::radians: return StaticValue::angle(number.value);
    case ast::Unit::centimetres: return StaticValue::number(number.value / 100);
    case ast::Unit::millimetres: return StaticValue::number(number.value / 1000);
    case ast::Unit::percent: return StaticValue::number(number.value / 100);
    case ast::Unit::none:
    case ast::Unit::metres: break;
  }
  return StaticValue::number(number.value);
}

std::optional<StaticValue> evaluate_static(const ast::Expr& expr, const StaticScope& scope, Diagnostics* diagnostics) {
  return Evaluator(scope, diagnostics).evaluate(expr);
}

std::optional<std::vector<StaticValue>> evaluate_static_list(const ast::List& list, const StaticScope& scope,
                                                             Diagnostics* diagnostics) {
  std::vector<StaticValue> values;
  for (const ast::ExprPtr& expr : list.values) {
    const auto value = evaluate_static(*expr, scope, diagnostics);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (!list.range) return values;
  const auto fault = [&](std::string message) {
    if (diagnostics) diagnostics->error("E0503", list.span, std::move(message));
    return std::nullopt;
  };
  const StaticValue first = values[0], last = values[1];
  if (first.kind != Kind::number || last.kind != Kind::number) return std::nullopt;
  const double steps = last.scalar() - first.scalar();
  if (steps != std::floor(steps))
    return fault(fmt::format("a range goes from first to last in steps of 1, and {}..{} does not end on its last value",
                             describe(first), describe(last)));
  if (steps >= kLongestList) return fault(fmt::format("a loop has at most {} turns", kLongestList));
  values.clear();
  for (int i = 0; i <= steps; ++i) values.push_back(StaticValue::number(first.scalar() + i));
  return values;
}

}  // namespace espalier
