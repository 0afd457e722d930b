#include "grammar/lsystem_cursor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/core.h>

namespace espalier::lsystem {
namespace {

constexpr int kDeepestExpression = 60;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_name_char(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

struct OperatorText {
  std::string_view text;
  Op op;
  int strength;
};

// Longer texts first, so that `<=` is not read as `<`.
constexpr std::array kOperators = {
    OperatorText{"||", Op::logical_or, 0},    OperatorText{"&&", Op::logical_and, 1},
    OperatorText{"<=", Op::less_equal, 2},    OperatorText{">=", Op::greater_equal, 2},
    OperatorText{"==", Op::equal, 2},         OperatorText{"!=", Op::not_equal, 2},
    OperatorText{"=", Op::equal, 2},          OperatorText{"<", Op::less, 2},
    OperatorText{">", Op::greater, 2},        OperatorText{"+", Op::add, 3},
    OperatorText{"-", Op::subtract, 3},       OperatorText{"**", Op::power, 5},
    OperatorText{"*", Op::multiply, 4},       OperatorText{"/", Op::divide, 4},
    OperatorText{"|", Op::logical_or, 0},     OperatorText{"&", Op::logical_and, 1},
};

struct Refusal {
  char symbol;
  std::string_view why, instead;
};

constexpr std::array kRefusals = {
    Refusal{'$', "`$` (roll until level) reads where the turtle is headed in the world",
            "leave it out, and write `aim z toward (0, 1, 0)` into the rule after the import"},
    Refusal{'{', "`{ }` polygons are traced by the turtle, and models here are made of meshes",
            "leave it out, and write `emit leaf` or a mesh of your own into the rule after the import"},
    Refusal{'}', "`{ }` polygons are traced by the turtle, and models here are made of meshes",
            "leave it out, and write `emit leaf` or a mesh of your own into the rule after the import"},
    Refusal{'.', "`.` marks a corner of a polygon, and models here are made of meshes",
            "leave it out, and write `emit leaf` or a mesh of your own into the rule after the import"},
    Refusal{'\'', "`'` steps through a table of colours, and there is none here",
            "leave it out, and write `paint` with a material into the rule after the import"},
    Refusal{'~', "`~` draws a surface from a library, and there is none here",
            "leave it out, and write `emit` with a mesh into the rule after the import"},
    Refusal{'%', "`%` cuts off a branch that has grown, and genes are not cut by others",
            "write the slot as `maybe p spawn ..` after the import, so that a search decides"},
    Refusal{'?', "`?` asks where the turtle is, and genes do not read the world",
            "leave it out; targets and guides look at the world for you"},
    Refusal{'#', "`#` inside a line is no comment (leave a blank before it), and widths only shrink, by `!`",
            "write `!(w)` with the width"},
    Refusal{'@', "`@` draws a circle or sphere",
            "leave it out, and write `emit sphere` into the rule after the import"},
    Refusal{'<', "context-sensitive productions look at their neighbours, and a gene does not know those",
            "hand down what it needs as a parameter, or let a search decide; see docs/from-lsystems.md"},
    Refusal{'>', "context-sensitive productions look at their neighbours, and a gene does not know those",
            "hand down what it needs as a parameter, or let a search decide; see docs/from-lsystems.md"},
};

}  // namespace

void Cursor::skip_blanks() {
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
    ++at_;
}

bool Cursor::accept(std::string_view text) {
  skip_blanks();
  if (text_.substr(at_, text.size()) != text) return false;
  at_ += text.size();
  return true;
}

void Cursor::expect(std::string_view text, std::string_view where) {
  if (accept(text)) return;
  const std::string found = at_end() ? "the end of the statement" : fmt::format("`{}`", peek());
  fail("L0101", here(), fmt::format("expected `{}` {}, found {}", text, where, found));
}

SourceSpan Cursor::span(std::size_t begin, std::size_t length) const {
  SourceSpan result = place_;
  result.offset += static_cast<std::uint32_t>(begin);
  result.length = static_cast<std::uint32_t>(length);
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), begin);
  result.line += static_cast<std::uint32_t>(next - line_starts_.begin());
  result.column = next == line_starts_.begin() ? place_.column + static_cast<std::uint32_t>(begin)
                                               : static_cast<std::uint32_t>(begin - *std::prev(next) + 1);
  return result;
}

void Cursor::fail(std::string code, const SourceSpan& where, std::string message, std::string help) {
  diagnostics_.error(std::move(code), where, std::move(message), std::move(help));
  throw SyntaxError{};
}

Expr Cursor::join(Op op, std::size_t begin, std::vector<Expr> children) {
  return {op, span(begin, at_ - begin), 0, {}, std::move(children)};
}

Op Cursor::operator_at(int strength) {
  skip_blanks();
  for (const OperatorText& o : kOperators) {
    if (text_.substr(at_, o.text.size()) != o.text) continue;
    if (o.strength != strength || text_.substr(at_, 2) == "->") return Op::number;
    at_ += o.text.size();
    return o.op;
  }
  return Op::number;
}

Expr Cursor::binary(int loosest) {
  constexpr int kTightest = 4;
  if (++level_ > kDeepestExpression * 6) fail("L0103", here(), "expressions nest at most 60 deep");
  skip_blanks();
  const std::size_t begin = at_;
  Expr left = loosest == kTightest ? prefix() : binary(loosest + 1);
  int height = 0;
  for (Op op; (op = operator_at(loosest)) != Op::number;) {
    if (++height > kDeepestExpression) fail("L0103", here(), "at most 60 operators in a row");
    Expr right = loosest == kTightest ? prefix() : binary(loosest + 1);
    std::vector<Expr> both;
    both.push_back(std::move(left));
    both.push_back(std::move(right));
    left = join(op, begin, std::move(both));
  }
  --level_;
  return left;
}

Expr Cursor::prefix() {
  if (++level_ > kDeepestExpression * 6) fail("L0103", here(), "expressions nest at most 60 deep");
  skip_blanks();
  const std::size_t begin = at_;
  Expr result;
  if (accept("-")) result = join(Op::negate, begin, {prefix()});
  else if (accept("!")) result = join(Op::logical_not, begin, {prefix()});
  else result = power();
  --level_;
  return result;
}

Expr Cursor::power() {
  skip_blanks();
  const std::size_t begin = at_;
  Expr base = primary();
  if (!accept("^") && operator_at(5) == Op::number) return base;
  std::vector<Expr> both;
  both.push_back(std::move(base));
  both.push_back(prefix());
  return join(Op::power, begin, std::move(both));
}

Expr Cursor::primary() {
  if (accept("(")) {
    Expr inner = expression();
    expect(")", "after the expression");
    return inner;
  }
  const std::size_t begin = (skip_blanks(), at_);
  if (is_digit(peek()) || peek() == '.') {
    Expr number{Op::number, {}, 0, {}, {}};
    const auto [end, fault] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number.value);
    if (fault != std::errc()) fail("L0102", here(), "a number was expected here, one that is not too large");
    at_ = static_cast<std::size_t>(end - text_.data());
    number.span = span(begin, at_ - begin);
    return number;
  }
  Expr result{Op::name, {}, 0, name("a number, a constant or a parameter"), {}};
  result.span = span(begin, at_ - begin);
  if (peek() == '(')
    fail("L0104", result.span, fmt::format("functions such as `{}` are not read", result.name),
         "compute the value beforehand, or write it into the grammar after the import");
  return result;
}

std::string Cursor::name(std::string_view what) {
  skip_blanks();
  std::size_t length = 0;
  while (at_ + length < text_.size() && is_name_char(text_[at_ + length])) ++length;
  if (length == 0 || is_digit(text_[at_])) fail("L0101", here(), fmt::format("expected {}", what));
  if (length > kLongestName)
    fail("L0103", span(at_, length), fmt::format("names have at most {} letters, this one {}", kLongestName, length));
  at_ += length;
  return std::string(text_.substr(at_ - length, length));
}

std::string Cursor::letter() {
  if (!is_letter(peek())) return {};
  std::size_t length = 1;
  if (at_ + 1 < text_.size() && text_[at_ + 1] == '_')
    while (at_ + length < text_.size() && (is_name_char(text_[at_ + length]))) ++length;
  if (length > kLongestName)
    fail("L0103", span(at_, length), fmt::format("names have at most {} letters, this one {}", kLongestName, length));
  at_ += length;
  return std::string(text_.substr(at_ - length, length));
}

std::vector<std::string> Cursor::params() {
  std::vector<std::string> result;
  if (!accept("(")) return result;
  do {
    const SourceSpan where = here();
    result.push_back(name("the name of a parameter"));
    if (std::count(result.begin(), result.end(), result.back()) > 1)
      fail("L0105", where, fmt::format("the parameter `{}` is there twice", result.back()));
    if (result.size() > kMostArguments) fail("L0103", where, fmt::format("at most {} parameters", kMostArguments));
  } while (accept(","));
  expect(")", "after the parameters");
  return result;
}

void Cursor::refuse_symbol() {
  const char c = peek();
  for (const Refusal& r : kRefusals)
    if (r.symbol == c) fail("L0201", here(), std::string(r.why), std::string(r.instead));
  fail("L0101", here(), (c & 0x80) ? std::string("a letter or a turtle symbol was expected here")
                                   : fmt::format("`{}` is neither a letter nor a turtle symbol", c));
}

std::string Cursor::symbol() {
  constexpr std::string_view kSymbols = "+-&^\\/|![]";
  const std::string result = letter();
  if (!result.empty()) return result;
  if (at_end() || kSymbols.find(peek()) == std::string_view::npos) refuse_symbol();
  return std::string(1, text_[at_++]);
}

Module Cursor::module() {
  skip_blanks();
  const std::size_t begin = at_;
  Module result;
  result.symbol = symbol();
  const bool bracket = result.symbol == "[" || result.symbol == "]";
  // The arguments follow at once; a blank before them is let pass.
  if (!bracket && accept("(")) {
    do result.args.push_back(expression());
    while (accept(","));
    expect(")", "after the arguments");
  }
  result.span = span(begin, at_ - begin);
  if (result.args.size() > kMostArguments)
    fail("L0103", result.span, fmt::format("at most {} arguments", kMostArguments));
  return result;
}

std::vector<Module> Cursor::modules() {
  std::vector<Module> result;
  std::vector<SourceSpan> open;
  while (!at_end() && peek() != ':') {
    result.push_back(module());
    if (result.size() > kMostModules)
      fail("L0103", result.back().span, fmt::format("at most {} modules in all successors", kMostModules));
    if (result.back().symbol == "[") open.push_back(result.back().span);
    if (static_cast<int>(open.size()) > kDeepestBrackets)
      fail("L0103", open.back(), fmt::format("brackets nest at most {} deep", kDeepestBrackets));
    if (result.back().symbol != "]") continue;
    if (open.empty()) fail("L0101", result.back().span, "this `]` closes nothing");
    open.pop_back();
  }
  if (!open.empty()) fail("L0101", open.back(), "this `[` is not closed");
  return result;
}

}  // namespace espalier::lsystem
