// Blocks, and how the parser finds its feet again after an error among their statements.

#include <algorithm>
#include <iterator>

#include <fmt/core.h>

#include "grammar/parser.h"
#include "grammar/parser_impl.h"
#include "grammar/spelling.h"
#include "grammar/words.h"

namespace espalier {

ast::Block Parser::block(std::string_view owner) {
  const Level level(*this);
  const Token first = peek();
  ast::Block result;
  if (!accept("{")) fail(fmt::format("`{{` and {}", owner));
  while (!at("}")) {
    if (at_end() || at_declaration_only()) {
      diagnostics_.error("E0113", first.span, "this `{` has no `}`",
                         at_end() ? std::string()
                                  : fmt::format("`{}` on line {} begins a declaration", peek().text, peek().span.line));
      result.span = since(first);
      return result;
    }
    statement_into(result);
  }
  take();
  result.span = since(first);
  return result;
}

void Parser::statement_into(ast::Block& block) {
  const std::size_t before = at_;
  try {
    block.statements.push_back(statement());
    if (++statements_ > kMostStatements) {
      at_ = tokens_.size() - 1;
      fail_at("E0105", block.statements.back()->span,
              fmt::format("a grammar has at most {} statements", kMostStatements));
    }
  } catch (const SyntaxError&) {
    if (at_ == before && !at("}")) take();
    recover();
  }
}

/// A word that begins a line and may be a statement misspelt.
bool Parser::at_new_line() const {
  if (peek().kind != TokenKind::word || at_ == 0 || tokens_[at_ - 1].span.line == peek().span.line) return false;
  constexpr std::string_view kJoins[] = {"and", "or", "mod", "by", "as", "at", "toward", "in", "else", "otherwise"};
  return std::find(std::begin(kJoins), std::end(kJoins), peek().text) == std::end(kJoins);
}

/// To the next statement, the `}` of the block that is open, or a declaration. A block whose head was wrong is still
/// read for its own faults, with the `else` blocks behind it.
void Parser::recover() {
  while (!at_end() && !at("}") && !at_statement() && !at_new_line() && !at_declaration_only()) take();
  while (at("{")) {
    block("a block");
    if (!accept("else")) return;
    while (!at_end() && !at("}") && !at("{") && !at_declaration_only()) take();
  }
}

bool Parser::at_declaration_only() const { return at_declaration() && !at("detail"); }

bool Parser::at_statement() const {
  const Token& token = peek();
  if (token.kind == TokenKind::word && peek(1).is("~")) return true;
  const auto words = statement_words();
  return (token.kind == TokenKind::word || token.is("{")) &&
         std::find(words.begin(), words.end(), token.text) != words.end();
}

void Parser::fail_statement() {
  const Token token = peek();
  const Token& next = peek(1);
  if (token.kind != TokenKind::word) fail("a statement");
  if (next.is("="))
    fail("a statement", fmt::format("write `let {} = ...`, or `{} ~ ...` for a draw", token.text, token.text));
  std::string help = did_you_mean(token.text, statement_words());
  if (help.empty() && token.is("else")) help = "`else` follows the block of an `if`, or the target of a `spawn`";
  if (help.empty() && next.is("("))
    help = fmt::format("a rule is made with `spawn {}`, a detail with `detail {}`", token.text, token.text);
  fail_at("E0112", token.span, fmt::format("`{}` begins no statement", token.text), help);
}

}  // namespace espalier
