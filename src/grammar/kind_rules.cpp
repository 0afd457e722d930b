#include "grammar/kind_rules.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

namespace espalier {
namespace {

using ast::Operator;

bool is_scalar(Kind kind) { return kind == Kind::number || kind == Kind::angle; }
bool is_spread(Kind a, Kind b) {
  const auto fits = [](Kind k) { return k == Kind::vector || k == Kind::number; };
  return fits(a) && fits(b) && (a == Kind::vector || b == Kind::vector);
}

std::optional<Kind> multiplied(Kind a, Kind b) {
  if (is_spread(a, b)) return Kind::vector;
  if (a == Kind::number && is_scalar(b)) return b;
  if (a == Kind::angle && b == Kind::number) return a;
  return std::nullopt;
}

std::optional<Kind> divided(Kind a, Kind b) {
  if (is_spread(a, b)) return Kind::vector;
  if (is_scalar(a) && b == Kind::number) return a;
  if (a == Kind::angle && b == Kind::angle) return Kind::number;
  return std::nullopt;
}

/// What a function takes and gives, in signatures of letters: n number, a angle, v vector, m material.
/// The last letter is the result.
struct Signatures {
  std::string_view name;
  std::string_view choices;  // space-separated
  std::string_view rule;
};

constexpr std::array kFunctions = {
    Signatures{"abs", "nn aa", "a number or an angle"},
    Signatures{"acos", "na", "a number and gives an angle"},
    Signatures{"asin", "na", "a number and gives an angle"},
    Signatures{"atan2", "nna", "two numbers (y, x) and gives an angle"},
    Signatures{"ceil", "nn", "a number"},
    Signatures{"clamp", "nnnn aaaa", "three numbers or three angles (value, low, high)"},
    Signatures{"cos", "an", "an angle"},
    Signatures{"cross", "vvv", "two vectors"},
    Signatures{"dot", "vvn", "two vectors"},
    Signatures{"exp", "nn", "a number"},
    Signatures{"floor", "nn", "a number"},
    Signatures{"length", "vn", "a vector"},
    Signatures{"log", "nn", "a number"},
    Signatures{"max", "nnn aaa", "two numbers or two angles"},
    Signatures{"min", "nnn aaa", "two numbers or two angles"},
    Signatures{"mix", "nnnn aana vvnv mmnm", "two values of one kind (number, angle, vector or material) and a number"},
    Signatures{"normalize", "vv", "a vector"},
    Signatures{"round", "nn", "a number"},
    Signatures{"sin", "an", "an angle"},
    Signatures{"smooth", "nnnn aaan", "three numbers or three angles (low, high, value)"},
    Signatures{"sqrt", "nn", "a number"},
    Signatures{"tan", "an", "an angle"},
    Signatures{"vec", "nv", "a number"},
};

Kind kind_of_letter(char letter) {
  switch (letter) {
    case 'n': return Kind::number;
    case 'a': return Kind::angle;
    case 'v': return Kind::vector;
    default: return Kind::material;
  }
}

const Signatures* find_function(std::string_view name) {
  const auto found = std::lower_bound(kFunctions.begin(), kFunctions.end(), name,
                                      [](const Signatures& s, std::string_view n) { return s.name < n; });
  return found != kFunctions.end() && found->name == name ? &*found : nullptr;
}

/// Calls `visit` with each signature of the function.
template <typename Visit>
void each_signature(const Signatures& function, Visit visit) {
  for (std::size_t begin = 0; begin < function.choices.size();) {
    const std::size_t end = std::min(function.choices.find(' ', begin), function.choices.size());
    visit(function.choices.substr(begin, end - begin));
    begin = end + 1;
  }
}

}  // namespace

std::optional<Kind> kind_of_unary(Operator op, Kind operand) {
  if (op == Operator::logical_not) return operand == Kind::boolean ? std::optional(operand) : std::nullopt;
  return is_scalar(operand) || operand == Kind::vector ? std::optional(operand) : std::nullopt;
}

std::optional<Kind> kind_of_binary(Operator op, Kind a, Kind b) {
  switch (op) {
    case Operator::add:
    case Operator::subtract:
      if (is_spread(a, b)) return Kind::vector;
      return is_scalar(a) && a == b ? std::optional(a) : std::nullopt;
    case Operator::multiply: return multiplied(a, b);
    case Operator::divide: return divided(a, b);
    case Operator::modulo: return is_scalar(a) && a == b ? std::optional(a) : std::nullopt;
    case Operator::power: return a == Kind::number && b == Kind::number ? std::optional(a) : std::nullopt;
    case Operator::less:
    case Operator::less_equal:
    case Operator::greater:
    case Operator::greater_equal: return is_scalar(a) && a == b ? std::optional(Kind::boolean) : std::nullopt;
    case Operator::equal:
    case Operator::not_equal:
      return (is_scalar(a) || a == Kind::boolean) && a == b ? std::optional(Kind::boolean) : std::nullopt;
    case Operator::logical_and:
    case Operator::logical_or: return a == Kind::boolean && b == a ? std::optional(a) : std::nullopt;
    default: return std::nullopt;
  }
}

std::optional<Kind> kind_of_function(std::string_view name, std::span<const Kind> arguments) {
  const Signatures* function = find_function(name);
  if (!function) return std::nullopt;
  std::optional<Kind> result;
  each_signature(*function, [&](std::string_view signature) {
    if (result || signature.size() != arguments.size() + 1) return;
    const auto fits = [&](std::size_t i) { return kind_of_letter(signature[i]) == arguments[i]; };
    for (std::size_t i = 0; i < arguments.size(); ++i)
      if (!fits(i)) return;
    result = kind_of_letter(signature.back());
  });
  return result;
}

std::optional<Kind> fixed_kind_of_function(std::string_view name) {
  const Signatures* function = find_function(name);
  if (!function) return std::nullopt;
  char letter = 0;
  bool fixed = true;
  each_signature(*function, [&](std::string_view signature) {
    if (letter != 0 && signature.back() != letter) fixed = false;
    letter = signature.back();
  });
  return fixed ? std::optional(kind_of_letter(letter)) : std::nullopt;
}

std::string_view text_of(Operator op) {
  switch (op) {
    case Operator::negate: return "-";
    case Operator::logical_not: return "not";
    case Operator::add: return "+";
    case Operator::subtract: return "-";
    case Operator::multiply: return "*";
    case Operator::divide: return "/";
    case Operator::modulo: return "mod";
    case Operator::power: return "^";
    case Operator::less: return "<";
    case Operator::less_equal: return "<=";
    case Operator::greater: return ">";
    case Operator::greater_equal: return ">=";
    case Operator::equal: return "==";
    case Operator::not_equal: return "!=";
    case Operator::logical_and: return "and";
    case Operator::logical_or: return "or";
    case Operator::none: break;
  }
  return "?";
}

std::string rule_of(Operator op) {
  const auto takes = [op](std::string_view what) { return fmt::format("`{}` takes {}", text_of(op), what); };
  switch (op) {
    case Operator::negate: return takes("a number, an angle or a vector");
    case Operator::logical_not: return takes("a boolean");
    case Operator::add:
    case Operator::subtract: return takes("two numbers, two angles, or vectors and numbers");
    case Operator::multiply: return takes("numbers, an angle and a number, or vectors and numbers");
    case Operator::divide: return takes("numbers, an angle by a number or an angle, or vectors and numbers");
    case Operator::power: return takes("two numbers");
    case Operator::modulo:
    case Operator::less:
    case Operator::less_equal:
    case Operator::greater:
    case Operator::greater_equal: return takes("two numbers or two angles");
    case Operator::equal:
    case Operator::not_equal: return takes("two numbers, two angles or two booleans");
    default: return takes("two booleans");
  }
}

std::string rule_of_function(std::string_view name) {
  const Signatures* function = find_function(name);
  return fmt::format("`{}` takes {}", name, function ? function->rule : "other arguments");
}

}  // namespace espalier
