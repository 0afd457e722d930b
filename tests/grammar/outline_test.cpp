#include "grammar/outline.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

constexpr const char* kText = R"(grammar g 1
const p = 0.25
const most = 30deg
start A
rule A {
  k ~ uniform(vec(0.5),   # at least
              vec(1))
  size k  emit box
  for i in 0..2 { gap ~ uniform(0deg, most)  turn y gap  maybe (p) spawn B(i) }
  spawn B(1)
}
rule B(n) limit 5 when depth < 3 and
  true {
  ink ~ pick(box, 2: cone(top: 0.5), sphere)
  choose { 1: { fat ~ chance(n / 10)  emit fat ? ink : quad } 1: { emit ink } }
  maybe clamp(0.9 - 0.1 * depth, 0.1, 0.9) spawn B(n)
}
)";

TEST(Outline, SaysWhatIsWrittenInOneLine) {
  const GrammarOutline outline = outline_of(kText);
  ASSERT_EQ(outline.rules.size(), 2u);
  const RuleOutline& a = outline.rules.at("A");
  ASSERT_EQ(a.draws.size(), 2u);
  EXPECT_EQ(a.draws[0].text, "uniform(vec(0.5), vec(1))");
  EXPECT_EQ(a.draws[0].kind, Kind::vector);
  EXPECT_EQ(a.draws[1].kind, Kind::angle) << "by what the name stands for";
  const RuleOutline& b = outline.rules.at("B");
  EXPECT_EQ(b.parameters, std::vector<std::string>{"n"});
  EXPECT_EQ(b.guard, "depth < 3 and true");
  EXPECT_EQ(b.draws[0].alternatives, (std::vector<std::string>{"box", "cone(top: 0.5)", "sphere"}));
  EXPECT_EQ(b.draws[1].distribution, "chance");
}

TEST(Outline, FindsProbabilitiesByTheirStatement) {
  const GrammarOutline outline = outline_of(kText);
  const std::string text = kText;
  ASSERT_EQ(outline.probabilities.size(), 2u);
  EXPECT_EQ(outline.probabilities.at(static_cast<std::uint32_t>(text.find("maybe (p)"))), "p");
  EXPECT_EQ(outline.probabilities.at(static_cast<std::uint32_t>(text.find("maybe clamp"))),
            "clamp(0.9 - 0.1 * depth, 0.1, 0.9)");
}

TEST(Outline, FindsTheDrawOfAComponent) {
  const GrammarOutline outline = outline_of(kText);
  EXPECT_EQ(outline.find_draw("A", "A.k.x"), &outline.rules.at("A").draws[0]);
  EXPECT_EQ(outline.find_draw("A", "A.gap[2]"), &outline.rules.at("A").draws[1]);
  EXPECT_EQ(outline.find_draw("A", "A.none"), nullptr);
  EXPECT_EQ(outline.find_draw("C", "C.k"), nullptr);
  EXPECT_EQ(outline.find_draw("A", "A"), nullptr);
}

TEST(Outline, OfATextThatDoesNotParseIsEmpty) {
  EXPECT_TRUE(outline_of("grammar g 1 start A rule A {").rules.empty());
  EXPECT_TRUE(outline_of("").rules.empty());
}

TEST(Outline, OfATextThatDoesNotCheckHasNoKinds) {
  const GrammarOutline outline =
      outline_of("grammar g 1 start A rule A { a ~ uniform(0deg, 9deg) turn y a spawn None }");
  ASSERT_EQ(outline.rules.at("A").draws.size(), 1u);
  EXPECT_EQ(outline.rules.at("A").draws[0].text, "uniform(0deg, 9deg)");
}

}  // namespace
}  // namespace espalier
