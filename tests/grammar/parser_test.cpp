#include "grammar/parser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/core.h>

namespace espalier {
namespace {

using ast::ExprKind;
using ast::Operator;
using ast::StmtKind;
using testing::ElementsAre;

std::vector<std::string> codes(const Diagnostics& diagnostics) {
  std::vector<std::string> result;
  for (const Diagnostic& d : diagnostics.items()) result.push_back(fmt::format("{} {}", d.code, d.span.line));
  return result;
}

/// An expression with its structure in parentheses.
std::string shape(const ast::Expr& expr) {
  static constexpr const char* kOperators[] = {"?", "-",  "not", "+",  "-",  "*",  "/",   "mod", "^",
                                               "<", "<=", ">",   ">=", "==", "!=", "and", "or"};
  std::string parts;
  for (const auto& child : expr.children) parts += " " + shape(*child);
  for (const auto& arg : expr.args)
    parts += " " + (arg.label ? shape(*arg.label) + ":" : std::string()) + shape(*arg.value);
  switch (expr.kind) {
    case ExprKind::number: return fmt::format("{}", expr.value);
    case ExprKind::text: return fmt::format("'{}'", expr.name);
    case ExprKind::boolean: return expr.value != 0 ? "true" : "false";
    case ExprKind::name: return expr.name;
    case ExprKind::call: return fmt::format("({}!{})", expr.name, parts);
    case ExprKind::vector: return fmt::format("(vector{})", parts);
    case ExprKind::ternary: return fmt::format("(if{})", parts);
    case ExprKind::member: return fmt::format("(.{}{})", "xyz"[static_cast<int>(expr.axis)], parts);
    default: return fmt::format("({}{})", kOperators[static_cast<int>(expr.op)], parts);
  }
}

std::string shape_of(const std::string& source) {
  Diagnostics diagnostics;
  const ast::ExprPtr expr = parse_expression(source, diagnostics);
  return expr ? shape(*expr) : codes(diagnostics).front();
}

ast::Grammar parse_body(const std::string& body, Diagnostics& diagnostics) {
  return parse("grammar g 1\nstart A\nrule A {" + body + "}\n", diagnostics);
}

const ast::Stmt& statement(const ast::Grammar& grammar, std::size_t i) {
  return *grammar.decls.at(1).body.statements.at(i);
}

TEST(Parser, BindsOperatorsByPrecedence) {
  EXPECT_EQ(shape_of("a or b and not c < d"), "(or a (and b (not (< c d))))");
  EXPECT_EQ(shape_of("1 - 2 - 3 * 4 / 5 mod 6"), "(- (- 1 2) (mod (/ (* 3 4) 5) 6))");
  EXPECT_EQ(shape_of("a ? b : c ? d : e"), "(if a b (if c d e))");
  EXPECT_EQ(shape_of("not a == b"), "(not (== a b))");
}

TEST(Parser, RaisesToPowersFromTheRightAndBeforeTheSign) {
  EXPECT_EQ(shape_of("-a ^ b"), "(- (^ a b))");
  EXPECT_EQ(shape_of("a ^ b ^ c"), "(^ a (^ b c))");
  EXPECT_EQ(shape_of("a ^ -b.x"), "(^ a (- (.x b)))");
  EXPECT_EQ(shape_of("--a"), "(- (- a))");
}

TEST(Parser, TellsVectorsFromParentheses) {
  EXPECT_EQ(shape_of("(a)"), "a");
  EXPECT_EQ(shape_of("(a, b, c).z"), "(.z (vector a b c))");
  EXPECT_EQ(shape_of("f(3: a, top: b)"), "(f! 3:a top:b)");
  EXPECT_EQ(shape_of("f(a ? b : c : d)"), "(f! (if a b c):d)");
}

TEST(Parser, RefusesWhatIsNoExpression) {
  for (const char* source :
       {"", "1 +", "a < b < c", "(1, 2)", "(1, 2, 3, 4)", "scope.w", "f(1", "+1", "1 2", "a.", "spawn", "[1]"})
    EXPECT_EQ(shape_of(source), "E0110 1") << source;
}

TEST(Parser, ReadsEveryDeclaration) {
  Diagnostics diagnostics;
  const ast::Grammar grammar = parse(R"(grammar name 1
import "a.esp"
start A
const c = 1
fn f(a, b) = a
attr t in 1..2 by 3 = 4 "G/L"
mesh m = "m.glb"
material s = surface("#000000")
rule A(k) limit 3 when depth < 2 { }
detail D { }
)",
                                     diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << render(diagnostics, "test", "");
  ASSERT_EQ(grammar.decls.size(), 9u);
  EXPECT_EQ(grammar.name, "name");
  EXPECT_EQ(grammar.decls[0].name, "a.esp");
  EXPECT_EQ(grammar.decls[3].params.size(), 2u);
  EXPECT_EQ(grammar.decls[4].label, "G/L");
  EXPECT_EQ(grammar.decls[4].step->value, 3);
  EXPECT_EQ(grammar.decls[7].limit, 3u);
  EXPECT_EQ(shape(*grammar.decls[7].guard), "(< depth 2)");
  EXPECT_EQ(grammar.decls[7].name_span.line, 9u);
  EXPECT_EQ(grammar.decls[7].name_span.column, 6u);
  EXPECT_EQ(grammar.decls[7].span.length, std::string("rule A(k) limit 3 when depth < 2 { }").size());
}

TEST(Parser, NeedsNothingBetweenStatements) {
  Diagnostics diagnostics;
  const ast::Grammar grammar =
      parse_body("let a = b  k ~ uniform(0, 1) move y -k turn (1, 0, 1) 3deg { emit box }", diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << render(diagnostics, "test", "");
  ASSERT_EQ(grammar.decls.at(1).body.statements.size(), 5u);
  EXPECT_EQ(statement(grammar, 0).kind, StmtKind::let);
  EXPECT_EQ(statement(grammar, 1).kind, StmtKind::draw);
  EXPECT_EQ(statement(grammar, 2).axis, ast::Axis::y);
  EXPECT_EQ(statement(grammar, 3).exprs.size(), 2u);
}

TEST(Parser, ReadsSlots) {
  Diagnostics diagnostics;
  const ast::Grammar grammar =
      parse_body("maybe 0.5 spawn B(1, 2) else detail C otherwise detail D(3) spawn E", diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  const ast::Stmt& slot = statement(grammar, 0);
  EXPECT_EQ(slot.target->args.size(), 2u);
  EXPECT_EQ(slot.on_empty->name, "C");
  EXPECT_EQ(slot.on_open->name, "D");
  EXPECT_FALSE(statement(grammar, 1).probability);
}

TEST(Parser, ReadsSplits) {
  Diagnostics diagnostics;
  const ast::Grammar grammar = parse_body("split x { ~1: { } repeat 2: { } 20%: { } } comp { top: { } }", diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  const ast::Stmt& split = statement(grammar, 0);
  EXPECT_EQ(split.cases[0].sizing, ast::Case::Sizing::floating);
  EXPECT_EQ(split.cases[1].sizing, ast::Case::Sizing::repeat);
  EXPECT_EQ(split.cases[2].value->unit, ast::Unit::percent);
  EXPECT_EQ(statement(grammar, 1).cases[0].face, "top");
}

TEST(Parser, MakesElseIfABlockWithOneStatement) {
  Diagnostics diagnostics;
  const ast::Grammar grammar = parse_body("if a { } else if b { } else { emit box }", diagnostics);
  const ast::Stmt& outer = statement(grammar, 0);
  ASSERT_EQ(outer.blocks.size(), 2u);
  ASSERT_EQ(outer.blocks[1].statements.size(), 1u);
  EXPECT_EQ(outer.blocks[1].statements[0]->kind, StmtKind::if_);
  EXPECT_EQ(outer.blocks[1].statements[0]->blocks[1].statements.size(), 1u);
}

TEST(Parser, GoesOnAfterAnError) {
  Diagnostics diagnostics;
  const ast::Grammar grammar = parse_body("\nmov y 1\nemit box\nif ( { emit }\nelse { size }\nemit box\n", diagnostics);
  EXPECT_THAT(codes(diagnostics), ElementsAre("E0112 4", "E0110 6", "E0110 6", "E0110 7"));
  EXPECT_EQ(grammar.decls.at(1).body.statements.size(), 2u);
}

TEST(Parser, GoesOnAtTheNextDeclaration) {
  Diagnostics diagnostics;
  const ast::Grammar grammar =
      parse("grammar g 1\nconst = 3\nrule A( { emit box }\nstart B\nrule C { {\nrule B { }\n", diagnostics);
  EXPECT_THAT(codes(diagnostics), ElementsAre("E0110 2", "E0110 3", "E0113 5", "E0113 5"));
  EXPECT_EQ(grammar.decls.back().name, "B");
}

TEST(Parser, LimitsNestingWithoutDroppingOff) {
  const auto first_code = [](const std::string& body) {
    Diagnostics diagnostics;
    parse_body(body, diagnostics);
    return diagnostics.items().empty() ? std::string("none") : diagnostics.items()[0].code;
  };
  const auto repeated = [](const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  const auto wrapped = [&](const std::string& open, const std::string& close, int times) {
    return repeated(open, times) + "emit box" + repeated(close, times);
  };
  EXPECT_EQ(first_code(wrapped("{", "}", 190)), "none");
  EXPECT_EQ(first_code(wrapped("{", "}", 210)), "E0106");
  EXPECT_EQ(first_code("size " + repeated("(", 190) + "1" + repeated(")", 190)), "none");
  EXPECT_EQ(first_code("size " + repeated("(", 100'000) + "1"), "E0106");
  EXPECT_EQ(first_code("size " + repeated("-", 100'000) + "1"), "E0106");
  EXPECT_EQ(first_code("size 1" + repeated(" ^ 2", 100'000)), "E0106");
  EXPECT_EQ(first_code("size 1" + repeated(" + 1", 150)), "none");
  EXPECT_EQ(first_code("size 1" + repeated(" + 1", 100'000)), "E0106");
  EXPECT_EQ(first_code("size scope" + repeated(".x", 100'000)), "E0106");
  EXPECT_EQ(first_code("size a" + repeated(" ? 1 : 2", 100'000)), "E0106");
  EXPECT_EQ(first_code("if a { }" + repeated(" else if a { }", 100'000)), "E0106");
}

TEST(Parser, LimitsSizeAndParameters) {
  Diagnostics large;
  EXPECT_TRUE(parse(std::string(kLargestSource + 1, ' '), large).decls.empty());
  EXPECT_THAT(codes(large), ElementsAre("E0105 0"));

  std::string blocks;
  for (std::size_t i = 0; i <= kMostStatements; ++i) blocks += "{}";
  Diagnostics many;
  parse_body(blocks, many);
  EXPECT_EQ(many.items().at(0).code, "E0105");

  std::string params = "p0";
  for (int i = 1; i <= 64; ++i) params += fmt::format(", p{}", i);
  Diagnostics wide;
  parse("grammar g 1\nrule A(" + params + ") { }", wide);
  EXPECT_THAT(codes(wide), ElementsAre("E0107 2"));
}

TEST(Parser, KeepsAtMostFiftyErrors) {
  std::string body;
  for (int i = 0; i < 10'000; ++i) body += "mov y 1\n";
  Diagnostics diagnostics;
  parse_body(body, diagnostics);
  EXPECT_EQ(diagnostics.items().size(), Diagnostics::kMostErrors);
}

TEST(Parser, PutsTheCaretUnderTheFault) {
  const std::string source = "grammar g 1\nstart A\nrule A {\n  move y 1\n  trun y 90deg\n}\n";
  Diagnostics diagnostics;
  parse(source, diagnostics);
  EXPECT_EQ(render(diagnostics, "g.esp", source),
            "g.esp:5:3: error[E0112]: `trun` begins no statement\n"
            "    5 |   trun y 90deg\n"
            "      |   ^^^^\n"
            "      = help: did you mean `turn`?\n"
            "g.esp: 1 error, 0 warnings\n");
}

}  // namespace
}  // namespace espalier
