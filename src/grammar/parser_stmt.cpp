// Statements, one function each where they are more than a word and a value.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/parser_impl.h"
#include "grammar/words.h"

namespace espalier {

using ast::StmtKind;
using ast::StmtPtr;

StmtPtr Parser::statement() {
  if (peek().kind == TokenKind::word && peek(1).is("~")) return draw();
  if (!at_statement()) fail_statement();
  const Token first = peek();
  auto stmt = std::make_unique<ast::Stmt>();
  if (first.is("{")) {
    stmt->kind = StmtKind::block;
    stmt->blocks.push_back(block("a block"));
  } else {
    take();
    statement_body(*stmt, first.text);
  }
  stmt->span = since(first);
  return stmt;
}

StmtPtr Parser::draw() {
  const Token name = expect_name("the name of a draw");
  auto stmt = std::make_unique<ast::Stmt>();
  stmt->kind = StmtKind::draw;
  stmt->name = name.text;
  stmt->name_span = name.span;
  take();
  if (peek().kind != TokenKind::word || !peek(1).is("("))
    fail("a distribution, such as `uniform(0, 1)`", "for a value without chance write `let NAME = ...`");
  const Token distribution = take();
  stmt->exprs.push_back(call(distribution));
  stmt->span = since(name);
  return stmt;
}

void Parser::statement_body(ast::Stmt& stmt, std::string_view word) {
  if (word == "let") {
    stmt.kind = StmtKind::let;
    const Token name = expect_name("the name of a value");
    stmt.name = name.text;
    stmt.name_span = name.span;
    expect("=", "and a value");
    stmt.exprs.push_back(expression());
  } else if (!structure_statement(stmt, word)) {
    output_statement(stmt, word);
  }
}

/// Statements with blocks or references. False where `word` begins another.
bool Parser::structure_statement(ast::Stmt& stmt, std::string_view word) {
  if (word == "if") {
    if_statement(stmt);
  } else if (word == "for") {
    for_statement(stmt);
  } else if (word == "choose" || word == "split" || word == "comp") {
    stmt.kind = word == "choose" ? StmtKind::choose : word == "split" ? StmtKind::split : StmtKind::comp;
    if (word == "split") stmt.axis = expect_axis();
    cases(stmt);
  } else if (word == "spawn" || word == "maybe") {
    spawn(stmt, word == "maybe");
  } else if (word == "detail") {
    stmt.kind = StmtKind::detail;
    stmt.target = reference("the name of a detail");
  } else if (word == "mirror" || word == "around") {
    stmt.kind = word == "mirror" ? StmtKind::mirror : StmtKind::around;
    stmt.axis = expect_axis();
    if (word == "around") stmt.exprs.push_back(expression());
    stmt.blocks.push_back(block("what is copied"));
  } else {
    return false;
  }
  return true;
}

/// Statements that change the state or put something out.
void Parser::output_statement(ast::Stmt& stmt, std::string_view word) {
  const auto plain = [&](StmtKind kind, bool axis = false) {
    stmt.kind = kind;
    if (axis) stmt.axis = accept_axis();
    stmt.exprs.push_back(expression());
  };
  if (word == "move") return plain(StmtKind::move, true);
  if (word == "scale") return plain(StmtKind::scale, true);
  if (word == "size") return plain(StmtKind::size, true);
  if (word == "resize") return plain(StmtKind::resize, true);
  if (word == "forward") return plain(StmtKind::forward);
  if (word == "yaw") return plain(StmtKind::yaw);
  if (word == "pitch") return plain(StmtKind::pitch);
  if (word == "roll") return plain(StmtKind::roll);
  if (word == "extrude") return plain(StmtKind::extrude);
  if (word == "paint") return plain(StmtKind::paint);
  if (word == "reseed") return plain(StmtKind::reseed);
  if (word == "turn") return turn(stmt);
  if (word == "aim") return aim(stmt);
  if (word == "emit") return emit(stmt);
  if (word == "reflect") {
    stmt.kind = StmtKind::reflect;
    stmt.axis = expect_axis();
    return;
  }
  plain(StmtKind::bone);
  expect("->", "and the end of the bone");
  stmt.exprs.push_back(expression());
}

void Parser::if_statement(ast::Stmt& stmt) {
  const Level level(*this);
  stmt.kind = StmtKind::if_;
  stmt.exprs.push_back(expression());
  stmt.blocks.push_back(block("what holds if so"));
  if (!accept("else")) return;
  if (!at("if")) {
    stmt.blocks.push_back(block("what holds otherwise"));
    return;
  }
  const Token first = take();
  auto nested = std::make_unique<ast::Stmt>();
  if_statement(*nested);
  nested->span = since(first);
  ast::Block holder;
  holder.span = nested->span;
  holder.statements.push_back(std::move(nested));
  stmt.blocks.push_back(std::move(holder));
}

void Parser::for_statement(ast::Stmt& stmt) {
  stmt.kind = StmtKind::for_;
  const Token name = expect_name("the name of a loop variable");
  stmt.name = name.text;
  stmt.name_span = name.span;
  expect("in", "and the values of the loop");
  stmt.list = list();
  stmt.blocks.push_back(block("what is repeated"));
}

void Parser::spawn(ast::Stmt& stmt, bool maybe) {
  stmt.kind = StmtKind::spawn;
  if (maybe) {
    stmt.probability = expression();
    expect("spawn", "after the probability");
  }
  stmt.target = reference("the name of a rule");
  if (accept("else")) {
    expect("detail", "and what an empty slot shows");
    stmt.on_empty = reference("the name of a detail");
  }
  if (accept("otherwise")) {
    expect("detail", "and what an open slot shows");
    stmt.on_open = reference("the name of a detail");
  }
}

void Parser::turn(ast::Stmt& stmt) {
  stmt.kind = StmtKind::turn;
  stmt.axis = accept_axis();
  if (!stmt.axis) {
    if (!at("(")) fail("an axis: x, y, z or a vector in parentheses");
    ast::ExprPtr about = parenthesized();
    if (about->kind != ast::ExprKind::vector)
      fail_at("E0110", about->span, "`turn` goes about x, y, z or a vector (a, b, c)");
    stmt.exprs.push_back(std::move(about));
  }
  stmt.exprs.push_back(expression());
}

void Parser::aim(ast::Stmt& stmt) {
  stmt.kind = StmtKind::aim;
  stmt.axis = expect_axis();
  stmt.at = at("at");
  if (!accept("at")) expect("toward", "and a direction, or `at` and a point");
  stmt.exprs.push_back(expression());
  if (accept("by")) stmt.exprs.push_back(expression());
}

void Parser::emit(ast::Stmt& stmt) {
  stmt.kind = StmtKind::emit;
  stmt.exprs.push_back(expression());
  while (accept("as")) {
    const SourceSpan word = peek().span;
    bool& flag = at("is") ? stmt.as_is : stmt.as_proxy;
    if (!at("is") && !at("proxy")) fail("`is` or `proxy`");
    if (flag || (&flag == &stmt.as_is && stmt.as_proxy))
      fail_at("E0110", word, "`emit` ends with at most one `as is`, then at most one `as proxy`");
    flag = true;
    take();
  }
}

void Parser::cases(ast::Stmt& stmt) {
  const Token first = peek();
  expect("{", "and the cases");
  while (!accept("}")) {
    if (at_end() || at_declaration_only()) {
      diagnostics_.error("E0113", first.span, "this `{` has no `}`");
      return;
    }
    try {
      stmt.cases.push_back(one_case(stmt.kind));
    } catch (const SyntaxError&) {
      while (!at_end() && !at("}") && !at("{") && !at_declaration_only()) take();
      if (at("{")) block("a block");
    }
  }
}

ast::Case Parser::one_case(StmtKind kind) {
  const Token first = peek();
  ast::Case result;
  if (kind == StmtKind::comp) {
    if (first.kind != TokenKind::word) fail("a face: front, back, left, right, top, bottom, sides or all");
    result.face = take().text;
  } else {
    if (kind == StmtKind::split && accept("~")) result.sizing = ast::Case::Sizing::floating;
    else if (kind == StmtKind::split && accept("repeat")) result.sizing = ast::Case::Sizing::repeat;
    result.value = expression();
  }
  expect(":", "and a block");
  result.block = block("what stands there");
  result.span = since(first);
  return result;
}

ast::Ref Parser::reference(std::string_view what) {
  const Token name = expect_name(what);
  ast::Ref result;
  result.name = name.text;
  if (accept("(")) {
    do result.args.push_back(expression());
    while (accept(","));
    expect(")", "after the arguments");
  }
  result.span = since(name);
  return result;
}

ast::Axis Parser::expect_axis() {
  const std::optional<ast::Axis> axis = accept_axis();
  if (!axis) fail("an axis: x, y or z");
  return *axis;
}

std::optional<ast::Axis> Parser::accept_axis() {
  if (peek().kind != TokenKind::word || !is_axis(peek().text)) return std::nullopt;
  return static_cast<ast::Axis>(take().text[0] - 'x');
}

}  // namespace espalier
