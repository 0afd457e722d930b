// Expressions: precedence climbing from `or` down to `* / mod`, then prefix, power, postfix, primary.

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "grammar/parser_impl.h"
#include "grammar/words.h"

namespace espalier {
namespace {

using ast::ExprKind;
using ast::ExprPtr;
using ast::Operator;

constexpr int kOr = 1, kAnd = 2, kNot = 3, kCompare = 4, kSum = 5, kProduct = 6;

struct BinaryOperator {
  std::string_view text;
  Operator op;
  int precedence;
};

constexpr std::array kOperators = {
    BinaryOperator{"or", Operator::logical_or, kOr},   BinaryOperator{"and", Operator::logical_and, kAnd},
    BinaryOperator{"<", Operator::less, kCompare},     BinaryOperator{"<=", Operator::less_equal, kCompare},
    BinaryOperator{">", Operator::greater, kCompare},  BinaryOperator{">=", Operator::greater_equal, kCompare},
    BinaryOperator{"==", Operator::equal, kCompare},   BinaryOperator{"!=", Operator::not_equal, kCompare},
    BinaryOperator{"+", Operator::add, kSum},          BinaryOperator{"-", Operator::subtract, kSum},
    BinaryOperator{"*", Operator::multiply, kProduct}, BinaryOperator{"/", Operator::divide, kProduct},
    BinaryOperator{"mod", Operator::modulo, kProduct},
};

const BinaryOperator* operator_at(const Token& token) {
  if (token.kind != TokenKind::word && token.kind != TokenKind::symbol) return nullptr;
  for (const BinaryOperator& o : kOperators)
    if (token.text == o.text) return &o;
  return nullptr;
}

}  // namespace

ExprPtr Parser::make(ExprKind kind, const Token& first) {
  auto expr = std::make_unique<ast::Expr>();
  expr->kind = kind;
  expr->span = first.span;
  return expr;
}

/// Sets span and height once the children are in place.
ExprPtr Parser::finish(ExprPtr expr, const Token& first) {
  expr->span = since(first);
  int tallest = 0;
  for (const ExprPtr& child : expr->children) tallest = std::max<int>(tallest, child->height);
  for (const ast::Arg& arg : expr->args) {
    tallest = std::max<int>(tallest, arg.value->height);
    if (arg.label) tallest = std::max<int>(tallest, arg.label->height);
  }
  expr->height = static_cast<std::uint16_t>(tallest + 1);
  check_height(*expr);
  return expr;
}

ExprPtr Parser::expression() {
  const Level level(*this);
  const Token first = peek();
  ExprPtr condition = binary(kOr);
  if (!accept("?")) return condition;
  ExprPtr expr = make(ExprKind::ternary, first);
  expr->children.push_back(std::move(condition));
  expr->children.push_back(expression());
  expect(":", "and the other value of `? :`");
  expr->children.push_back(expression());
  return finish(std::move(expr), first);
}

/// Operators that bind as tightly as `loosest` or tighter; left to right, comparisons not in a row.
ExprPtr Parser::binary(int loosest) {
  const Token first = peek();
  if (loosest == kNot) {
    if (!at("not")) return binary(kCompare);
    take();
    ExprPtr expr = make(ExprKind::unary, first);
    expr->op = Operator::logical_not;
    expr->children.push_back(binary(kCompare));
    return finish(std::move(expr), first);
  }
  ExprPtr left = loosest == kProduct ? prefix() : binary(loosest + 1);
  for (const BinaryOperator* o; (o = operator_at(peek())) && o->precedence == loosest;) {
    take();
    ExprPtr expr = make(ExprKind::binary, first);
    expr->op = o->op;
    expr->children.push_back(std::move(left));
    expr->children.push_back(loosest == kProduct ? prefix() : binary(loosest + 1));
    left = finish(std::move(expr), first);
    if (loosest != kCompare) continue;
    if (const BinaryOperator* next = operator_at(peek()); next && next->precedence == kCompare)
      fail("one comparison at a time", "write `a < b and b < c`");
  }
  return left;
}

ExprPtr Parser::prefix() {
  if (!at("-")) return power();
  const Level level(*this);
  const Token first = take();
  ExprPtr expr = make(ExprKind::unary, first);
  expr->op = Operator::negate;
  expr->children.push_back(prefix());
  return finish(std::move(expr), first);
}

ExprPtr Parser::power() {
  const Token first = peek();
  ExprPtr base = postfix();
  if (!at("^")) return base;
  const Level level(*this);
  take();
  ExprPtr expr = make(ExprKind::binary, first);
  expr->op = Operator::power;
  expr->children.push_back(std::move(base));
  expr->children.push_back(prefix());
  return finish(std::move(expr), first);
}

ExprPtr Parser::postfix() {
  const Token first = peek();
  ExprPtr value = primary();
  while (accept(".")) {
    ExprPtr expr = make(ExprKind::member, first);
    expr->axis = expect_axis();
    expr->children.push_back(std::move(value));
    value = finish(std::move(expr), first);
  }
  return value;
}

ExprPtr Parser::primary() {
  const Token first = peek();
  if (first.is("(")) return parenthesized();
  if (first.kind == TokenKind::number) {
    ExprPtr expr = make(ExprKind::number, take());
    expr->value = first.value;
    expr->unit = first.unit;
    return expr;
  }
  if (first.kind == TokenKind::text) {
    ExprPtr expr = make(ExprKind::text, take());
    expr->name = first.text;
    return expr;
  }
  if (first.is("true") || first.is("false")) {
    ExprPtr expr = make(ExprKind::boolean, take());
    expr->value = first.text == "true" ? 1 : 0;
    return expr;
  }
  const bool name = first.kind == TokenKind::word && (!is_reserved(first.text) || find_builtin(first.text));
  if (!name) {
    std::string help;
    if (first.is("+")) help = "a number needs no `+`";
    if (first.is("not")) help = "put the negation in parentheses: `(not a)`";
    fail("a value", help);
  }
  take();
  if (at("(")) return call(first);
  ExprPtr expr = make(ExprKind::name, first);
  expr->name = first.text;
  return expr;
}

/// "(" expr ")" or "(" expr "," expr "," expr ")".
ExprPtr Parser::parenthesized() {
  const Token first = take();
  ExprPtr inner = expression();
  if (accept(")")) return inner;
  if (!at(",")) fail("`)`");
  ExprPtr expr = make(ExprKind::vector, first);
  expr->children.push_back(std::move(inner));
  while (accept(",")) {
    if (expr->children.size() == 3) fail("`)` after three components", "a vector has three components");
    expr->children.push_back(expression());
  }
  if (at(")") && expr->children.size() != 3) fail("a third component", "a vector has three components");
  expect(")", "after the vector");
  return finish(std::move(expr), first);
}

ExprPtr Parser::call(const Token& name) {
  ExprPtr expr = make(ExprKind::call, name);
  expr->name = name.text;
  take();
  if (!at(")")) {
    do {
      ast::Arg arg;
      arg.value = expression();
      if (accept(":")) {
        arg.label = std::move(arg.value);
        arg.value = expression();
      }
      expr->args.push_back(std::move(arg));
    } while (accept(","));
  }
  expect(")", "after the arguments");
  return finish(std::move(expr), name);
}

ast::List Parser::list() {
  const Token first = peek();
  ast::List result;
  if (accept("[")) {
    do result.values.push_back(expression());
    while (accept(","));
    expect("]", "after the list");
  } else {
    result.range = true;
    result.values.push_back(expression());
    expect("..", "and the last value of the loop");
    result.values.push_back(expression());
  }
  result.span = since(first);
  return result;
}

}  // namespace espalier
