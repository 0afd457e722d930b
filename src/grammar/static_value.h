#pragma once
// StaticValue: a value known before the search starts, and the evaluator that makes it from an expression of literals,
// consts, attrs, loop variables and pure functions of those.

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/ast.h"
#include "grammar/kind.h"

namespace espalier {

struct CheckedGrammar;

/// number: numbers[0], lengths in metres; angle: numbers[0] in radians; vector: all three; boolean: numbers[0] is 0 or
/// 1; text: `text` is the contents; mesh, material: `text` is the declared name or the primitive.
struct StaticValue {
  Kind kind = Kind::number;
  std::array<double, 3> numbers{};
  std::string text;

  static StaticValue number(double value) { return {Kind::number, {value, 0, 0}, {}}; }
  static StaticValue angle(double radians) { return {Kind::angle, {radians, 0, 0}, {}}; }
  static StaticValue boolean(bool value) { return {Kind::boolean, {value ? 1.0 : 0.0, 0, 0}, {}}; }
  static StaticValue vector(double x, double y, double z) { return {Kind::vector, {x, y, z}, {}}; }

  double scalar() const { return numbers[0]; }
  bool truth() const { return numbers[0] != 0; }
  bool operator==(const StaticValue&) const = default;
};

/// "1.5", "30deg", "(1, 2, 3)", "true": as a person would write it.
std::string describe(const StaticValue& value);

/// What a static expression may read.
struct StaticScope {
  const CheckedGrammar& grammar;
  /// Whether attrs count as static here. They do not where the genome is shaped: lists of `for` in rules.
  bool attributes = true;
  /// Loop variables by name. `depth` and `depth(R)` are static too where they stand here under just those names.
  std::map<std::string, StaticValue, std::less<>> locals{};
};

/// A literal number with its unit applied: degrees to radians, cm and mm to m, percent to a fraction.
StaticValue literal_value(const ast::Expr& number);

/// The value, or nothing where the expression is not static or has an error (kind, division by zero, not finite).
/// Errors go to `diagnostics`, if given; being not static is none. Double arithmetic.
std::optional<StaticValue> evaluate_static(const ast::Expr& expr, const StaticScope& scope,
                                           Diagnostics* diagnostics = nullptr);

/// The values of a `for` list; a range runs from first to last in steps of 1 and is empty where last < first.
/// At most kLongestList values.
inline constexpr int kLongestList = 100'000;
std::optional<std::vector<StaticValue>> evaluate_static_list(const ast::List& list, const StaticScope& scope,
                                                             Diagnostics* diagnostics = nullptr);

}  // namespace espalier
