#include "grammar/outline.h"

#include <gtest/gtest.h>

#include "grammar/compiler.h"

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

GrammarOutline outlined(const std::string& text) {
  const CompileResult result = compile_grammar({"test.esp", text});
  EXPECT_TRUE(result.checked) << render(result.diagnostics, result.sources);
  return result.checked ? outline_of(*result.checked, result.sources) : GrammarOutline{};
}

TEST(Outline, SaysWhatIsWrittenInOneLine) {
  const GrammarOutline outline = outlined(kText);
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
  const GrammarOutline outline = outlined(kText);
  const auto at = [](const char* words) {
    return std::pair<std::uint16_t, std::uint32_t>(0, static_cast<std::uint32_t>(std::string(kText).find(words)));
  };
  ASSERT_EQ(outline.probabilities.size(), 2u);
  EXPECT_EQ(outline.probabilities.at(at("maybe (p)")), "p");
  EXPECT_EQ(outline.probabilities.at(at("maybe clamp")),
            "clamp(0.9 - 0.1 * depth, 0.1, 0.9)");
}

TEST(Outline, FindsTheDrawOfAComponent) {
  const GrammarOutline outline = outlined(kText);
  EXPECT_EQ(outline.find_draw("A", "A.k.x"), &outline.rules.at("A").draws[0]);
  EXPECT_EQ(outline.find_draw("A", "A.gap[2]"), &outline.rules.at("A").draws[1]);
  EXPECT_EQ(outline.find_draw("A", "A.none"), nullptr);
  EXPECT_EQ(outline.find_draw("C", "C.k"), nullptr);
  EXPECT_EQ(outline.find_draw("A", "A"), nullptr);
}

TEST(Outline, ReadsImportedTextsToo) {
  const ReadImport read = [](const std::string&) {
    return "# longer than the text that imports it, so that offsets differ\ngrammar part 1 start P "
           "rule P { a ~ uniform(0, 9) size a  maybe 0.25 spawn P }";
  };
  const CompileResult result = compile_grammar({"g.esp", "grammar g 1 import \"p.esp\" start S rule S { spawn P }", {}, read});
  ASSERT_TRUE(result.graph);
  const GrammarOutline outline = outline_of(*result.checked, result.sources);
  EXPECT_EQ(outline.rules.at("P").draws.at(0).text, "uniform(0, 9)");
  for (const Edge& edge : result.graph->edges) {
    if (edge.required) continue;
    EXPECT_EQ(outline.probabilities.at({edge.span.file, edge.span.offset}), "0.25");
  }
}

}  // namespace
}  // namespace espalier
