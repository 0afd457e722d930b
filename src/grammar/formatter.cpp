#include "grammar/formatter.h"

#include <algorithm>

#include "base/check.h"
#include "grammar/layout_page.h"
#include "grammar/layout_printer.h"
#include "grammar/layout_tokens.h"
#include "grammar/layout_tree.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

/// Whether two texts have the same tokens and comments in the same order. Whoever formats a file trusts us with it.
bool same_but_for_blanks(std::string_view a, std::string_view b) {
  Diagnostics none;
  std::vector<Comment> comments_a, comments_b;
  const std::vector<Token> tokens_a = tokenize(a, none, 0, &comments_a),
                           tokens_b = tokenize(b, none, 0, &comments_b);
  const auto same_token = [](const Token& s, const Token& t) { return s.kind == t.kind && s.text == t.text; };
  const auto same_comment = [](const Comment& s, const Comment& t) {
    return s.text == t.text && s.next_token == t.next_token && s.own_line == t.own_line;
  };
  return std::equal(tokens_a.begin(), tokens_a.end(), tokens_b.begin(), tokens_b.end(), same_token) &&
         std::equal(comments_a.begin(), comments_a.end(), comments_b.begin(), comments_b.end(), same_comment);
}

}  // namespace

std::optional<std::string> format_grammar(std::string_view source, Diagnostics& diagnostics) {
  const ast::Grammar grammar = parse(source, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  const LayoutTokens tokens(source, grammar);
  LayoutPage page;
  LayoutPrinter(tokens, page).file(layout_of(grammar, tokens));
  std::string text = page.finish();
  CHECK(same_but_for_blanks(source, text));
  return text;
}

}  // namespace espalier
