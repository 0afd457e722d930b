#pragma once
// The lexer: text -> tokens. White space goes; comments go too, or into a list of their own for whoever writes the text
// anew; numbers carry their unit.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/ast.h"

namespace espalier {

enum class TokenKind : std::uint8_t {
  word,    // name or keyword
  number,  // value and unit
  text,    // "..."
  symbol,  // { } ( ) [ ] , : . .. ~ = ? + - * / ^ < <= > >= == != ->
  end,     // once, at the end of the text
};

struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;  // as in the source; of a text without its quotes
  SourceSpan span;
  double value = 0;       // number, unit not applied
  ast::Unit unit = ast::Unit::none;

  bool is(std::string_view word_or_symbol) const {
    return (kind == TokenKind::word || kind == TokenKind::symbol) && text == word_or_symbol;
  }
};

/// A comment: from `#` to the end of its line, without white space at its end.
struct Comment {
  std::string_view text;       // as in the source
  SourceSpan span;
  bool own_line = false;       // no token stands before it on its line
  std::size_t next_token = 0;  // index of the token behind it
};

/// The tokens of `source`, which they point into. What is no token is reported and left out; after
/// Diagnostics::kMostErrors of those the rest of the text is not read. `file` goes into their spans. The comments go to
/// `comments`, if given.
std::vector<Token> tokenize(std::string_view source, Diagnostics& diagnostics, std::uint16_t file = 0,
                            std::vector<Comment>* comments = nullptr);

/// "`move`", "the number `3`", "the end of the text": for messages.
std::string describe(const Token& token);

}  // namespace espalier
