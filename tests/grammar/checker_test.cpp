#include "grammar/checker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/core.h>

#include "base/math.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Checked {
  std::optional<CheckedGrammar> grammar;
  Diagnostics diagnostics;

  std::vector<std::string> codes() const {
    std::vector<std::string> result;
    for (const Diagnostic& d : diagnostics.items()) result.push_back(d.code);
    return result;
  }
};

Checked check_text(const std::string& declarations, const std::map<std::string, std::string>& overrides = {}) {
  Checked result;
  result.grammar =
      check(parse("grammar g 1 start A " + declarations, result.diagnostics), overrides, result.diagnostics);
  return result;
}

TEST(Checker, RefusesATreeWithSyntaxErrors) {
  const Checked checked = check_text("rule A { emit }");
  EXPECT_FALSE(checked.grammar);
  EXPECT_THAT(checked.codes(), ElementsAre("E0110"));
}

TEST(Checker, EvaluatesConstsInAnyOrder) {
  const Checked checked = check_text("const a = b * 2 const b = f(c) fn f(v) = v + 1 const c = 20cm rule A { size a }");
  ASSERT_TRUE(checked.grammar);
  EXPECT_DOUBLE_EQ(checked.grammar->constants.at("a").scalar(), 2.4);
  EXPECT_EQ(checked.grammar->start, "A");
}

TEST(Checker, InfersKindsFromCalls) {
  const Checked checked = check_text(
      "fn up(v, a) = v * cos(a) material red = surface(\"#ff0000\") "
      "rule A { k ~ uniform(0, 1) t ~ angle() let v = up((0, k, 0), t) spawn B(k, t, v, k > 0.5, red, box) } "
      "rule B(n, a, v, b, m, e) { move n * v turn y a paint m if b { emit e } maybe 0.5 spawn B(n, a, v, b, m, e) }");
  ASSERT_TRUE(checked.grammar) << render(checked.diagnostics, "", "");
  EXPECT_THAT(checked.grammar->parameter_kinds.at("B"),
              ElementsAre(Kind::number, Kind::angle, Kind::vector, Kind::boolean, Kind::material, Kind::mesh));
  EXPECT_THAT(checked.grammar->parameter_kinds.at("up"), ElementsAre(Kind::vector, Kind::angle));
  EXPECT_EQ(checked.grammar->function_kinds.at("up"), Kind::vector);
  EXPECT_EQ(checked.grammar->global_kinds.at("v"), Kind::vector);
  EXPECT_EQ(checked.grammar->global_kinds.at("t"), Kind::angle);
}

TEST(Checker, MarksKindsInTheTree) {
  const Checked checked = check_text("rule A { k ~ uniform(vec(0), vec(1)) turn y 90deg * k.x emit box }");
  ASSERT_TRUE(checked.grammar);
  const auto& statements = checked.grammar->find("A")->body.statements;
  EXPECT_EQ(statements[0]->exprs[0]->value_kind, Kind::vector);
  EXPECT_EQ(statements[1]->exprs[0]->value_kind, Kind::angle);
  EXPECT_EQ(statements[1]->exprs[0]->children[1]->value_kind, Kind::number);
  EXPECT_EQ(statements[2]->exprs[0]->value_kind, Kind::mesh);
}

TEST(Checker, TellsWhatIsReachable) {
  const Checked checked =
      check_text("rule A { spawn B } rule B { detail C } detail C { } rule D { spawn E } rule E { }");
  ASSERT_TRUE(checked.grammar);
  EXPECT_TRUE(checked.grammar->reachable.at("C"));
  EXPECT_FALSE(checked.grammar->reachable.at("D"));
  EXPECT_FALSE(checked.grammar->reachable.at("E"));
  EXPECT_THAT(checked.codes(), ElementsAre("W0222", "W0222"));
}

TEST(Checker, LetsDetailsUseWhatIsDynamic) {
  const Checked checked = check_text(
      "attr n = 3 rule A { start_k ~ uniform(1, 2) detail D(start_k) } "
      "detail D(k) { m ~ integer(0, k * n) for i in 0..m { for j in [i, m] { c ~ chance(k / 2) if c { move x j emit "
      "box } } } "
      "choose { k: { u ~ normal(k, k, -k, k) size u } m: { if depth > n { emit leaf } } } around y m { emit box } }");
  EXPECT_TRUE(checked.grammar) << render(checked.diagnostics, "", "");
  EXPECT_THAT(checked.codes(), IsEmpty());
}

const char* const kAttributes =
    "attr tall in 0.5..4 = 1.6 attr lean in 0deg..90deg by 5deg = 10deg attr open = false attr free = 3 "
    "rule A { size tall move x free turn y lean if open { emit box } }";

TEST(Checker, OverridesAttributes) {
  const Checked checked =
      check_text(kAttributes, {{"tall", "200cm"}, {"lean", "45deg"}, {"open", "true"}, {"free", "-1e3"}});
  ASSERT_TRUE(checked.grammar) << render(checked.diagnostics, "", "");
  const auto& attributes = checked.grammar->attributes;
  EXPECT_DOUBLE_EQ(attributes.at("tall").value.scalar(), 2);
  EXPECT_DOUBLE_EQ(attributes.at("tall").default_value.scalar(), 1.6);
  EXPECT_DOUBLE_EQ(attributes.at("lean").value.scalar(), kPi / 4);
  EXPECT_DOUBLE_EQ(attributes.at("lean").high, kPi / 2);
  EXPECT_DOUBLE_EQ(attributes.at("lean").step, kPi / 36);
  EXPECT_TRUE(attributes.at("open").value.truth());
  EXPECT_EQ(attributes.at("free").value.scalar(), -1000);
}

TEST(Checker, RefusesWrongOverridesWithoutAPlace) {
  const auto only_code = [](const std::string& name, const std::string& value) {
    const Checked checked = check_text(kAttributes, {{name, value}});
    EXPECT_FALSE(checked.grammar) << name << " = " << value;
    EXPECT_EQ(checked.diagnostics.items().size(), 1u);
    EXPECT_EQ(checked.diagnostics.items()[0].span.line, 0u);
    return checked.codes().front();
  };
  EXPECT_EQ(only_code("tal", "1"), "E0703");
  EXPECT_EQ(only_code("tall", "5"), "E0705");
  EXPECT_EQ(only_code("tall", "0.4"), "E0705");
  for (const char* text : {"30deg", "true", "", "box", "1 +", "1 2", "50%", "\"1\"", "1 / 0", "tall", "(1, 2, 3)"})
    EXPECT_EQ(only_code("tall", text), "E0704") << text;
  EXPECT_EQ(only_code("lean", "30"), "E0704");
  EXPECT_EQ(only_code("open", "1"), "E0704");
}

TEST(Checker, NamesTheRuleAndTheValueInOverrides) {
  const Checked checked = check_text(kAttributes, {{"tall", "5"}, {"leen", "1deg"}});
  EXPECT_EQ(render(checked.diagnostics, "g.esp", ""),
            "g.esp: error[E0703]: there is no attr `leen` to set; did you mean `lean`?\n"
            "g.esp: error[E0705]: the attr `tall` must be in 0.5..4, got 5\n"
            "g.esp: 2 errors, 0 warnings\n");
}

TEST(Checker, LimitsTheNumberOfRules) {
  std::string rules;
  for (int i = 0; i <= 65'535; ++i) rules += fmt::format("detail D{} {{}}", i);
  const auto codes = check_text("rule A { emit box }" + rules).codes();
  EXPECT_THAT(codes, testing::Contains("E0605"));
}

// The expected number of children of B decides, to the last digit.
TEST(Checker, DrawsTheLineAtASpectralRadiusOfOne) {
  const auto accepted = [](const std::string& probability) {
    return check_text("rule A { spawn B } rule B { emit box for i in 0..3 { maybe " + probability +
                      " spawn C } } "
                      "rule C { maybe 0.5 spawn B  maybe 0.5 spawn B }")
        .grammar.has_value();
  };
  EXPECT_TRUE(accepted("0.2499"));
  EXPECT_FALSE(accepted("0.25"));
  EXPECT_FALSE(accepted("0.2501"));
}

TEST(Checker, FindsCyclesThatOnlyAlternate) {
  // A -> B -> A ..., twice 2 * 0.4 each way: radius 0.8 * 1.3 > 1 although B alone makes less than one.
  EXPECT_THAT(check_text("rule A { spawn B } rule B { emit box maybe 0.4 spawn C maybe 0.4 spawn C } "
                         "rule C { spawn B  maybe 0.3 spawn B }")
                  .codes(),
              ElementsAre("E0802"));
  EXPECT_THAT(check_text("rule A { spawn B } rule B { emit box maybe 0.4 spawn C maybe 0.4 spawn C } "
                         "rule C { spawn B  maybe 0.2 spawn B }")
                  .codes(),
              IsEmpty());
}

TEST(Checker, TakesChoicesByTheirWeights) {
  const auto rule = [](int weight) {
    return fmt::format("rule A {{ spawn B }} rule B {{ choose {{ {}: {{ emit box }} 2: {{ spawn B  spawn B }} }} }}",
                       weight);
  };
  EXPECT_THAT(check_text(rule(2)).codes(), ElementsAre("E0802"));
  EXPECT_THAT(check_text(rule(3)).codes(), IsEmpty());
}

TEST(Checker, WarnsOfManyGenesBehindAGuard) {
  const auto codes = [](int depth) {
    return check_text(fmt::format("rule A {{ spawn B }} rule B when depth < {} {{ emit box spawn B spawn B }}", depth))
        .codes();
  };
  EXPECT_THAT(codes(19), IsEmpty());             // 2^18 genes
  EXPECT_THAT(codes(22), ElementsAre("W0803"));  // 2^21
}

TEST(Checker, CountsDepthPerRuleInTheExpectedSize) {
  // Only every other gene is a B, so the guard on depth(B) lets the tree grow twice as deep.
  EXPECT_THAT(check_text("rule A { spawn B } rule B when depth(B) < 9 { emit box spawn C spawn C } "
                         "rule C { spawn B spawn B }")
                  .codes(),
              IsEmpty());
  EXPECT_THAT(check_text("rule A { spawn B } rule B when depth(B) < 10 { emit box spawn C spawn C } "
                         "rule C { spawn B spawn B }")
                  .codes(),
              ElementsAre("W0803"));
}

TEST(Checker, LetsLimitsBoundTheExpectedSize) {
  EXPECT_THAT(check_text("rule A { spawn B } rule B limit 50 { emit box for i in 0..9 { maybe 0.9 spawn B } }").codes(),
              IsEmpty());
}

TEST(Checker, KnowsThatAbsentSlotsEndRequiredRecursion) {
  EXPECT_THAT(check_text("rule A { spawn B } rule B when depth < 9 { emit box spawn C } rule C { spawn B }").codes(),
              IsEmpty());
  EXPECT_THAT(check_text("rule A { spawn B } rule B when depth > 0 { emit box spawn C } rule C { spawn B }").codes(),
              ElementsAre("E0801"));
}

}  // namespace
}  // namespace espalier
