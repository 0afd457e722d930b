#include "render/generator_diagram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/error.h"
#include "derivation/random_graph.h"
#include "grammar/compiler.h"
#include "render/xml_check.h"

namespace espalier {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_xml;
using testing::XmlDocument;

constexpr const char* kText = R"(grammar town 1
const p = 0.25
start Lot
rule Lot { wide ~ uniform(1, 2)  size wide  spawn House  for i in 0..3 { maybe p spawn Tree(i) } }
rule House limit 7 when depth < 9 {
  choose { 1: { emit box } 1: { tall ~ uniform(1, 2)  size tall  emit box } }
  maybe 1/3 spawn House else detail Roof otherwise detail Scaffold
  maybe clamp(1 - 0.1 * depth, 0.1, 0.9) spawn Tree(1)
}
rule Tree(n) { move x n  detail Leaf  emit cone  maybe 0.1 spawn House }
detail Roof { emit pyramid }
detail Scaffold { emit box }
detail Leaf { emit leaf }
)";

CompileResult compiled(const std::string& text) {
  CompileResult result = compile_grammar({"test.esp", text, {}});
  EXPECT_TRUE(result.graph) << render(result.diagnostics, "test.esp", text);
  return result;
}

XmlDocument drawn(const std::string& text) {
  const CompileResult result = compiled(text);
  const XmlDocument doc = read_xml(generator_diagram(*result.graph, outline_of(*result.checked, result.sources)));
  EXPECT_EQ(doc.fault, "");
  return doc;
}

TEST(GeneratorDiagram, ShowsEveryRuleAndDetailOnceInItsOwnWords) {
  const auto texts = drawn(kText).texts();
  for (const char* words : {"town", "Lot", "House", "Tree(n)", "Roof", "Scaffold", "Leaf",
                            "3 rules, 5 edges, 3 details", "wide ~ uniform(1, 2)", "tall ~ uniform(1, 2)",
                            "when depth < 9", "limit 7", "2 variants"}) {
    EXPECT_EQ(texts.count(words), 1u) << words;
  }
}

TEST(GeneratorDiagram, ShowsEveryEdgeOnceWithItsProbability) {
  const XmlDocument doc = drawn(kText);
  const auto texts = doc.texts();
  for (const char* words : {"1/3", "p = 0.25 \u00d74", "clamp(1 - 0.1 * depth, 0.1, 0.9)", "0.1", "else",
                            "otherwise"}) {
    EXPECT_EQ(texts.count(words), 1u) << words;
  }
  const auto hints = doc.texts("title");
  for (const char* hint : {"Lot/House: required, 1 slot", "Lot/Tree: optional, p = 0.25, 4 slots",
                           "House/House: optional, 1/3, 1 slot", "Tree/House: optional, 0.1, 1 slot",
                           "House calls Roof", "House calls Scaffold", "Tree calls Leaf"}) {
    EXPECT_EQ(hints.count(hint), 1u) << hint;
  }
}

TEST(GeneratorDiagram, RequiredIsSolidAndOptionalDashed) {
  // The keys of the legend, and one required and four optional edges.
  const XmlDocument doc = drawn(kText);
  int solid = 0, dashed = 0, dotted = 0;
  for (const auto* path : doc.named("path")) {
    if (!path->attributes.contains("marker-end")) continue;
    const auto dashes = path->attributes.find("stroke-dasharray");
    if (dashes == path->attributes.end()) ++solid;
    else if (dashes->second == "6 4") ++dashed;
    else ++dotted;
  }
  EXPECT_EQ(solid, 1 + 1);
  EXPECT_EQ(dashed, 4 + 1);
  EXPECT_EQ(dotted, 3 + 1);
}

TEST(GeneratorDiagram, WithoutTheTextItShowsNamesAndNumbers) {
  const auto graph = compiled(kText).graph;
  const XmlDocument doc = read_xml(generator_diagram(*graph, {}));
  ASSERT_EQ(doc.fault, "");
  const auto texts = doc.texts();
  for (const char* words : {"Tree", "wide ~", "tall ~", "has a guard", "0.333", "0.25 \u00d74", "by depth"}) {
    EXPECT_EQ(texts.count(words), 1u) << words;
  }
}

TEST(GeneratorDiagram, DrawsInLoopsSayHowOften) {
  const auto texts = drawn(R"(grammar g 1 start A
rule A { for i in 0..2 { k ~ uniform(vec(1), vec(2))  size k  emit box } })").texts();
  EXPECT_EQ(texts.count("k ~ uniform(vec(1), vec(2))  \u00d73"), 1u);
}

TEST(GeneratorDiagram, LongRangesAreCutAndKeptAsHints) {
  std::string sum = "1";
  for (int i = 0; i < 40; ++i) sum += " + 1";
  const XmlDocument doc = drawn("grammar g 1 start A rule A { k ~ uniform(0.5, " + sum + ")  size k  emit box }");
  EXPECT_THAT(doc.texts(), Not(Contains(HasSubstr(sum))));
  EXPECT_THAT(doc.texts("title"), Contains(HasSubstr(sum)));
}

RC_GTEST_PROP(GeneratorDiagram, RandomGraphsAreDrawnTheSameTwiceWithEveryEdge, (std::uint32_t seed)) {
  RandomStream random({seed, Purpose::test, 0, 0, 0});
  const GeneratorGraph graph = test::random_graph(random);
  const std::string svg = generator_diagram(graph, {});
  RC_ASSERT(svg == generator_diagram(graph, {}));
  const XmlDocument doc = read_xml(svg);
  RC_ASSERT(doc.fault == "");
  std::size_t arrows = 0;
  for (const auto* path : doc.named("path")) arrows += path->attributes.contains("marker-end");
  RC_ASSERT(arrows == graph.edges.size() - 1 + 2);
  const auto texts = doc.texts();
  for (const Rule& rule : graph.rules) RC_ASSERT(texts.count(rule.name) == 1u);
}

}  // namespace
}  // namespace espalier
