#pragma once
// What operators and functions make of kinds: one table for the checker and the evaluator of static values.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "grammar/ast.h"
#include "grammar/kind.h"

namespace espalier {

/// The kind of the result; nothing where the operator takes no such operand.
std::optional<Kind> kind_of_unary(ast::Operator op, Kind operand);
std::optional<Kind> kind_of_binary(ast::Operator op, Kind left, Kind right);
/// Functions only (`sin`, `mix`, ...); as many arguments as the table in words.h asks for.
std::optional<Kind> kind_of_function(std::string_view name, std::span<const Kind> arguments);
/// The kind of a built-in function's result where it does not depend on the arguments.
std::optional<Kind> fixed_kind_of_function(std::string_view name);

/// "+", "and", ...
std::string_view text_of(ast::Operator op);
/// What the operator or function takes: "`and` takes two booleans".
std::string rule_of(ast::Operator op);
std::string rule_of_function(std::string_view name);

}  // namespace espalier
