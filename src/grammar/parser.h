#pragma once
// The parser: text -> syntax tree, by recursive descent over the EBNF of docs/language.md. It goes on after an error at
// the next statement or declaration, so that several errors come out in one go.

#include <cstddef>
#include <string_view>

#include "base/diagnostic.h"
#include "grammar/ast.h"

namespace espalier {

/// Longer texts are refused (E0105).
inline constexpr std::size_t kLargestSource = std::size_t{4} << 20;
/// Deeper braces, parentheses and operators are refused (E0106).
inline constexpr int kDeepestNesting = 200;
/// More statements are refused (E0105).
inline constexpr std::size_t kMostStatements = 200'000;

/// The tree of `source`, imports unread; a best effort where `diagnostics` has errors afterwards. `file` goes into
/// spans.
ast::Grammar parse(std::string_view source, Diagnostics& diagnostics, std::uint16_t file = 0);

/// One expression alone, such as the value of an attribute on a command line; null where there are errors.
ast::ExprPtr parse_expression(std::string_view source, Diagnostics& diagnostics);

}  // namespace espalier
