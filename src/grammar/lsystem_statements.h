#pragma once
// The statements of an L-system file, still as text. Private to the parser.

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace espalier::lsystem {

struct Statement {
  std::string text;  // comments blanked out; may span lines
  SourceSpan span;   // of its first byte
};

/// A statement is a line, with the lines behind it that begin with a blank and hold no arrow.
std::vector<Statement> statements(std::string_view source);

}  // namespace espalier::lsystem
