#pragma once
// An L-system as its author wrote it: an axiom, constants and productions over modules, in the notation of "The
// Algorithmic Beauty of Plants" (Prusinkiewicz and Lindenmayer, 1990). The file format is in docs/from-lsystems.md.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace espalier::lsystem {

enum class Op : std::uint8_t {
  number, name, negate, logical_not, logical_or, logical_and,
  less, less_equal, greater, greater_equal, equal, not_equal, add, subtract, multiply, divide, power,
};

/// Arithmetic over constants and parameters. Truth is a number other than 0.
struct Expr {
  Op op = Op::number;
  SourceSpan span;
  double value = 0;
  std::string name;
  std::vector<Expr> children;
};

/// A symbol and its arguments: `F`, `+(30)`, `A(l * 0.7, w)`.
struct Module {
  std::string symbol;
  std::vector<Expr> args;
  SourceSpan span;
};

struct Production {
  std::string symbol;
  std::vector<std::string> params;
  std::optional<Expr> guard, probability;
  std::vector<Module> successor;
  SourceSpan span;  // of the predecessor
};

struct Constant {
  std::string name;
  Expr value;
  double number = 0;
};

struct System {
  std::vector<Module> axiom;
  int iterations = 4;
  double angle = 90;     // degrees
  double step = 1;       // length of F and f without argument
  double width = 0.1;    // of a segment at first
  double thinner = 0.7;  // what `!` without argument multiplies the width by
  std::string draw = "F", move = "f";  // symbols whose segments are drawn, and that only move
  std::vector<Constant> constants;
  std::vector<Production> productions;
};

inline constexpr std::size_t kLargestFile = 256 * 1024;
inline constexpr std::size_t kMostProductions = 500;
inline constexpr std::size_t kMostModules = 20'000;  // of all successors and the axiom
inline constexpr std::size_t kMostConstants = 500;
inline constexpr std::size_t kMostArguments = 16;
inline constexpr std::size_t kLongestName = 40;
inline constexpr int kDeepestBrackets = 60;
inline constexpr int kMostIterations = 40;

/// The system that `source` describes; nothing where `diagnostics` has errors afterwards (codes L0101 to L0299).
std::optional<System> parse(std::string_view source, Diagnostics& diagnostics);

/// The value of an expression whose names `value_of` knows; nothing where that is not finite or a name is not known.
using Values = std::function<std::optional<double>(const std::string&)>;
std::optional<double> evaluate(const Expr& expr, const Values& value_of);

/// As an expression of our language, names spelled by `spell`.
using Spelling = std::function<std::string(const std::string&)>;
std::string spell(const Expr& expr, const Spelling& spell_name);

bool reads(const Expr& expr, const std::string& name);

/// `number` as our language writes it.
std::string spell(double number);

}  // namespace espalier::lsystem
