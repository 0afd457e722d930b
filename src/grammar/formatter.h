#pragma once
// The formatter: a grammar's text in the layout of the house. It works from the syntax tree and changes white space
// alone: every token keeps its spelling, every comment its place among them. Authors decide which statements share a
// line and which blocks are open; the formatter indents, spaces, and breaks what is longer than kLongestLine.

#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.h"

namespace espalier {

/// Columns of code; comments may go beyond.
inline constexpr int kLongestLine = 100;

/// The formatted text: idempotent, ends with one line end, line ends are "\n". Nothing where `source` does not parse;
/// `diagnostics` then says why. Linear time.
std::optional<std::string> format_grammar(std::string_view source, Diagnostics& diagnostics);

}  // namespace espalier
