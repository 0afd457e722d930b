#include "grammar/parser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "grammar/parser_impl.h"
#include "grammar/spelling.h"
#include "grammar/words.h"

namespace espalier {

// Cursor.

Token Parser::take() {
  const Token token = peek();
  if (at_ + 1 < tokens_.size()) ++at_;
  return token;
}

bool Parser::accept(std::string_view word_or_symbol) {
  if (!at(word_or_symbol)) return false;
  take();
  return true;
}

void Parser::expect(std::string_view word_or_symbol, std::string_view where) {
  if (!accept(word_or_symbol)) fail(fmt::format("`{}` {}", word_or_symbol, where));
}

Token Parser::expect_name(std::string_view what) {
  if (peek().kind != TokenKind::word) fail(what);
  if (is_reserved(peek().text))
    fail_at("E0111", peek().span, fmt::format("`{}` is a word of the language and cannot be {}", peek().text, what),
            fmt::format("pick another name, such as `{}_`", peek().text));
  return take();
}

std::uint32_t Parser::expect_count(std::string_view what) {
  const Token& token = peek();
  const bool whole = token.kind == TokenKind::number && token.unit == ast::Unit::none &&
                     token.text.find_first_not_of("0123456789") == std::string_view::npos;
  if (!whole) fail(what);
  if (token.value > std::numeric_limits<std::uint32_t>::max())
    fail_at("E0103", token.span, fmt::format("{} is at most 4294967295", what));
  return static_cast<std::uint32_t>(take().value);
}

void Parser::fail(std::string_view expected, std::string help) {
  fail_at("E0110", peek().span, fmt::format("expected {}, found {}", expected, describe(peek())), std::move(help));
}

void Parser::fail_at(std::string code, const SourceSpan& span, std::string message, std::string help) {
  diagnostics_.error(std::move(code), span, std::move(message), std::move(help));
  if (diagnostics_.error_count() >= Diagnostics::kMostErrors) at_ = tokens_.size() - 1;
  throw SyntaxError{};
}

SourceSpan Parser::since(const Token& first) const {
  SourceSpan span = first.span;
  const SourceSpan& last = at_ > 0 ? tokens_[at_ - 1].span : first.span;
  if (last.offset + last.length > span.offset) span.length = last.offset + last.length - span.offset;
  return span;
}

void Parser::enter() {
  if (++level_ <= kDeepestNesting) return;
  const SourceSpan span = peek().span;
  --level_;  // the guard that called does not live
  at_ = tokens_.size() - 1;
  fail_at("E0106", span, fmt::format("braces, parentheses and operators nest at most {} deep", kDeepestNesting),
          "name parts of it with `let`, or move them to rules or details of their own");
}

void Parser::check_height(const ast::Expr& expr) {
  if (expr.height <= kDeepestNesting) return;
  fail_at("E0106", expr.span, fmt::format("operators nest at most {} deep", kDeepestNesting),
          "name parts of it with `let`");
}

// Declarations.

ast::Grammar Parser::file() {
  ast::Grammar grammar;
  try {
    header(grammar);
  } catch (const SyntaxError&) {
    skip_to_declaration();
  }
  while (!at_end()) {
    try {
      grammar.decls.push_back(declaration());
    } catch (const SyntaxError&) {
      skip_to_declaration();
    }
  }
  return grammar;
}

void Parser::header(ast::Grammar& grammar) {
  expect("grammar", "NAME 1 as the first line");
  if (peek().kind != TokenKind::word) fail("the name of the grammar");
  const Token name = take();
  grammar.name = name.text;
  grammar.name_span = name.span;
  const SourceSpan version_span = peek().span;
  grammar.language_version = expect_count("the version of the language, 1");
  if (grammar.language_version != 1)
    diagnostics_.error("E0120", version_span,
                       fmt::format("the version of the language is 1, not {}", grammar.language_version));
}

ast::Decl Parser::declaration() {
  const Token first = peek();
  if (!at_declaration()) {
    const std::string help =
        first.kind == TokenKind::word ? did_you_mean(first.text, declaration_words()) : std::string();
    fail("a declaration (rule, detail, const, attr, fn, mesh, material, start, import)", help);
  }
  take();
  ast::Decl decl;
  decl.name_span = peek().span;
  const std::string_view word = first.text;
  if (word == "import") {
    if (peek().kind != TokenKind::text) fail("the path of a grammar in quotes");
    decl.kind = ast::DeclKind::import;
    decl.name = take().text;
  } else if (word == "start") {
    decl.kind = ast::DeclKind::start;
    decl.name = expect_name("the name of the start rule").text;
  } else if (word == "const") {
    value_declaration(decl, ast::DeclKind::constant, "the name of a const");
  } else if (word == "mesh") {
    value_declaration(decl, ast::DeclKind::mesh, "the name of a mesh");
  } else if (word == "material") {
    value_declaration(decl, ast::DeclKind::material, "the name of a material");
  } else if (word == "fn") {
    value_declaration(decl, ast::DeclKind::function, "the name of a function");
  } else if (word == "attr") {
    attribute(decl);
  } else {
    decl.kind = word == "rule" ? ast::DeclKind::rule : ast::DeclKind::detail;
    rule(decl);
  }
  decl.span = since(first);
  return decl;
}

void Parser::value_declaration(ast::Decl& decl, ast::DeclKind kind, std::string_view what) {
  decl.kind = kind;
  decl.name = expect_name(what).text;
  if (kind == ast::DeclKind::function) {
    if (!at("(")) fail("`(` and the parameters of the function");
    decl.params = params();
  }
  expect("=", "and a value");
  decl.value = expression();
}

void Parser::attribute(ast::Decl& decl) {
  decl.kind = ast::DeclKind::attribute;
  decl.name = expect_name("the name of an attr").text;
  if (accept("in")) {
    decl.low = expression();
    expect("..", "between the ends of the range");
    decl.high = expression();
    if (accept("by")) decl.step = expression();
  }
  expect("=", "and the default of the attr");
  decl.value = expression();
  if (peek().kind == TokenKind::text) decl.label = take().text;
}

void Parser::rule(ast::Decl& decl) {
  const bool is_rule = decl.kind == ast::DeclKind::rule;
  decl.name = expect_name(is_rule ? "the name of a rule" : "the name of a detail").text;
  if (at("(")) decl.params = params();
  if (is_rule && accept("limit")) decl.limit = expect_count("the limit, a whole number");
  if (is_rule && accept("when")) decl.guard = expression();
  if (!is_rule && (at("limit") || at("when"))) fail("`{`", "only rules have a limit or a guard");
  decl.body = block(is_rule ? "the body of the rule" : "the body of the detail");
}

std::vector<ast::Param> Parser::params() {
  constexpr std::size_t kMostParams = 64;
  std::vector<ast::Param> list;
  expect("(", "and the parameters");
  do {
    const Token name = expect_name("the name of a parameter");
    list.push_back({std::string(name.text), name.span});
    if (list.size() > kMostParams) fail_at("E0107", name.span, fmt::format("at most {} parameters", kMostParams));
  } while (accept(","));
  expect(")", "after the parameters");
  return list;
}

bool Parser::at_declaration() const {
  const auto words = declaration_words();
  return peek().kind == TokenKind::word && std::find(words.begin(), words.end(), peek().text) != words.end();
}

/// `detail` begins statements too; as a declaration it is taken to stand at the beginning of its line.
void Parser::skip_to_declaration() {
  while (!at_end() && !(at_declaration() && (!at("detail") || peek().span.column == 1))) take();
}

// Entry points.

ast::Grammar parse(std::string_view source, Diagnostics& diagnostics, std::uint16_t file) {
  if (source.size() > kLargestSource) {
    diagnostics.error(
        "E0105", SourceSpan{.file = file},
        fmt::format("a grammar is at most {} bytes long, this one has {}", kLargestSource, source.size()));
    return {};
  }
  return Parser(tokenize(source, diagnostics, file), diagnostics).file();
}

ast::ExprPtr Parser::lone_expression() {
  try {
    ast::ExprPtr expr = expression();
    if (at_end()) return expr;
    fail("the end of the value");
  } catch (const SyntaxError&) {
    return nullptr;
  }
}

ast::ExprPtr parse_expression(std::string_view source, Diagnostics& diagnostics) {
  if (source.size() > kLargestSource) {
    diagnostics.error("E0105", SourceSpan{}, "the value is too long");
    return nullptr;
  }
  ast::ExprPtr expr = Parser(tokenize(source, diagnostics), diagnostics).lone_expression();
  return diagnostics.has_errors() ? nullptr : std::move(expr);
}

}  // namespace espalier
