#include "grammar/static_value.h"

#include <cmath>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "base/math.h"
#include "grammar/checker.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

/// With const c = 3, attr t = 2 (a number) and fn twice(v) = 2 * v.
CheckedGrammar checked() {
  Diagnostics diagnostics;
  auto grammar = check(parse("grammar g 1 start A const c = 3 attr t = 2 fn twice(v) = 2 * v mesh m = box "
                             "rule A { size c * t * twice(1) emit m }",
                             diagnostics),
                       {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  return std::move(*grammar);
}

std::string value_of(const std::string& source, Diagnostics* found = nullptr) {
  const CheckedGrammar grammar = checked();
  StaticScope scope{grammar};
  scope.locals["i"] = StaticValue::number(7);
  scope.locals["depth(A)"] = StaticValue::number(4);
  Diagnostics diagnostics;
  const ast::ExprPtr expr = parse_expression(source, diagnostics);
  EXPECT_TRUE(expr) << source;
  const auto value = evaluate_static(*expr, scope, found);
  return value ? describe(*value) : "none";
}

TEST(StaticValue, AppliesUnits) {
  EXPECT_EQ(value_of("90deg"), "90deg");
  EXPECT_EQ(value_of("1m + 20cm + 3mm"), "1.203");
  EXPECT_EQ(value_of("180deg / 1rad"), fmt::format("{:.9g}", kPi));
}

TEST(StaticValue, ComputesWithNumbersAnglesAndVectors) {
  EXPECT_EQ(value_of("2 + 3 * 4 - 6 / 4"), "12.5");
  EXPECT_EQ(value_of("-7 mod 3"), "2");  // of the sign of the divisor
  EXPECT_EQ(value_of("2 ^ 10"), "1024");
  EXPECT_EQ(value_of("30deg * 2 - 15deg"), "45deg");
  EXPECT_EQ(value_of("(1, 2, 3) * 2 + vec(1)"), "(3, 5, 7)");
  EXPECT_EQ(value_of("6 / (1, 2, 3)"), "(6, 3, 2)");
  EXPECT_EQ(value_of("-(1, 2, 3).y"), "-2");
  EXPECT_EQ(value_of("cross((1, 0, 0), (0, 1, 0))"), "(0, 0, 1)");
  EXPECT_EQ(value_of("dot((1, 2, 3), (4, 5, 6))"), "32");
  EXPECT_EQ(value_of("length(3 * normalize((1, 2, 2)))"), "3");
}

TEST(StaticValue, ComputesFunctions) {
  EXPECT_EQ(value_of("sin(30deg)"), "0.5");
  EXPECT_EQ(value_of("atan2(1, 1)"), "45deg");
  EXPECT_EQ(value_of("round(2.5) + round(-2.5)"), "1");  // halves go up
  EXPECT_EQ(value_of("clamp(5, 0, 1) + min(2, 3) + max(2deg, 3deg) / 1deg"), "6");
  EXPECT_EQ(value_of("mix(1, 3, 0.25)"), "1.5");
  EXPECT_EQ(value_of("mix((0, 0, 0), (2, 4, 6), 0.5)"), "(1, 2, 3)");
  EXPECT_EQ(value_of("smooth(0, 2, 1)"), "0.5");
}

TEST(StaticValue, DecidesConditions) {
  EXPECT_EQ(value_of("1 < 2 and not (2deg >= 3deg) or false"), "true");
  EXPECT_EQ(value_of("true != false"), "true");
  EXPECT_EQ(value_of("i > 3 ? 1 : 1 / 0"), "1");  // the other side is left alone
}

TEST(StaticValue, ReadsConstsAttrsFunctionsAndLocals) {
  EXPECT_EQ(value_of("c + t + twice(i)"), "19");
  EXPECT_EQ(value_of("depth(A) + 1"), "5");
  EXPECT_EQ(value_of("m"), "m");
  EXPECT_EQ(value_of("sphere"), "sphere");
}

TEST(StaticValue, HasNoneWhereSomethingIsNotStatic) {
  Diagnostics found;
  for (const char* source : {"scope.x", "depth", "depth(B)", "nowhere", "i > 3 ? scope.x : 1", "cone(top: 1)"})
    EXPECT_EQ(value_of(source, &found), "none") << source;
  EXPECT_TRUE(found.items().empty());
}

TEST(StaticValue, ReportsWhatHasNoValue) {
  Diagnostics found;
  EXPECT_EQ(value_of("1 / (c - 3)", &found), "none");
  EXPECT_EQ(value_of("1 mod 0", &found), "none");
  EXPECT_EQ(value_of("sqrt(-1)", &found), "none");
  EXPECT_EQ(value_of("1e300 * 1e300", &found), "none");
  EXPECT_EQ(value_of("normalize((0, 0, 0))", &found), "none");
  ASSERT_EQ(found.items().size(), 5u);
  EXPECT_EQ(found.items()[0].code, "E0501");
  EXPECT_EQ(found.items()[4].code, "E0502");
}

TEST(StaticValue, LeavesAttrsOutWhereTheyDoNotCount) {
  const CheckedGrammar grammar = checked();
  const StaticScope scope{grammar, false, {}};
  Diagnostics diagnostics;
  EXPECT_FALSE(evaluate_static(*parse_expression("t", diagnostics), scope));
  EXPECT_TRUE(evaluate_static(*parse_expression("c", diagnostics), scope));
}

std::string list_of(const std::string& list) {
  const CheckedGrammar grammar = checked();
  Diagnostics diagnostics;
  const ast::Grammar loop = parse("grammar g 1 rule A { for i in " + list + " { } }", diagnostics);
  const auto values =
      evaluate_static_list(loop.decls.at(0).body.statements.at(0)->list, StaticScope{grammar}, &diagnostics);
  std::string text;
  if (!values) return diagnostics.items().empty() ? "none" : diagnostics.items()[0].code;
  for (const StaticValue& value : *values) text += describe(value) + " ";
  return text;
}

TEST(StaticValue, EnumeratesLists) {
  EXPECT_EQ(list_of("[3, 1, c]"), "3 1 3 ");
  EXPECT_EQ(list_of("-1..1"), "-1 0 1 ");
  EXPECT_EQ(list_of("0.5..2.5"), "0.5 1.5 2.5 ");
  EXPECT_EQ(list_of("1..0"), "");
  EXPECT_EQ(list_of("0..0.5"), "E0503");
  EXPECT_EQ(list_of("1..100001"), "E0503");
  EXPECT_EQ(list_of("0..scope.x"), "none");
}

}  // namespace
}  // namespace espalier
