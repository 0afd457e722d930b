#include "render/derivation_diagram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "model/draw_values.h"
#include "render/xml_check.h"

namespace espalier {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::read_xml;
using testing::XmlDocument;

constexpr const char* kText = R"(grammar bush 1
start Root
rule Root { base ~ uniform(1, 1.0001)  size base  spawn Stem }
rule Stem when depth < 40 {
  k ~ uniform(vec(2), vec(2.0001))
  lean ~ uniform(30deg, 30.001deg)
  ink ~ pick(box, 3: cone)
  fat ~ chance(0.5)
  { size k  turn z lean  emit fat ? ink : sphere }
  choose { 1: { emit box } 1: { emit cone } }
  maybe 0.9 spawn Stem
  maybe 0.9 spawn Tip
}
rule Tip when depth < 3 { emit sphere })";

class DerivationDiagram : public ::testing::Test {
 protected:
  void SetUp() override {
    const CompileResult result = compile_grammar({"bush.esp", kText, {}});
    graph_ = result.graph;
    ASSERT_TRUE(graph_) << render(result.diagnostics, "bush.esp", kText);
    outline_ = outline_of(*result.checked, result.sources);
  }

  Derivation grown(std::uint32_t genes) {
    RandomStream random({3, Purpose::test, 0, 0, 0});
    Derivation d = seedling(*graph_, random);
    while (d.size() < genes && grow_open_slot(*graph_, d, random) == GrowthStep::grown) {}
    return d;
  }
  std::string svg(const Derivation& d) {
    return derivation_diagram(*graph_, d, outline_, draw_values(*graph_, d));
  }
  XmlDocument drawn(const Derivation& d) {
    const XmlDocument doc = read_xml(svg(d));
    EXPECT_EQ(doc.fault, "");
    return doc;
  }
  static std::size_t genes_in(const XmlDocument& doc) {
    std::size_t genes = 0;
    for (const std::string& hint : doc.texts("title")) genes += hint.starts_with("gene ");
    return genes;
  }

  std::shared_ptr<const GeneratorGraph> graph_;
  GrammarOutline outline_;
};

TEST_F(DerivationDiagram, ShowsGenesWithVariantsAndValues) {
  const Derivation d = grown(3);
  const auto texts = drawn(d).texts();
  EXPECT_EQ(texts.count("Root"), 1u);
  EXPECT_EQ(texts.count("base 1"), 1u);
  EXPECT_EQ(texts.count("Stem (1)") + texts.count("Stem (2)"), texts.count("k 2, 2, 2"));
  EXPECT_EQ(texts.count("lean 30\u00b0"), texts.count("k 2, 2, 2"));
  EXPECT_EQ(texts.count("ink box") + texts.count("ink cone"), texts.count("k 2, 2, 2"));
  EXPECT_EQ(texts.count("fat true") + texts.count("fat false"), texts.count("k 2, 2, 2"));
  EXPECT_GE(texts.count("k 2, 2, 2"), 1u);
}

TEST_F(DerivationDiagram, ShowsEveryGeneAndSlotOnce) {
  for (const std::uint32_t genes : {1u, 5u, 12u}) {
    const Derivation d = grown(genes);
    const XmlDocument doc = drawn(d);
    EXPECT_EQ(genes_in(doc), d.size());
    std::size_t slots[4] = {}, open = 0, empty = 0, absent = 0;
    for (const SlotState s : d.slots) ++slots[static_cast<int>(s)];
    for (const std::string& hint : doc.texts("title")) {
      open += hint.find(": open") != std::string::npos;
      empty += hint.find(": empty") != std::string::npos;
      absent += hint.find(": absent") != std::string::npos;
    }
    EXPECT_EQ(open, slots[static_cast<int>(SlotState::open)]);
    EXPECT_EQ(empty, slots[static_cast<int>(SlotState::empty)]);
    EXPECT_EQ(absent, slots[static_cast<int>(SlotState::absent)]);
  }
}

TEST_F(DerivationDiagram, UnknownValuesAreShownAsQuantiles) {
  Derivation d = grown(2);
  for (std::uint32_t& draw : d.draws) draw = 0x40000000;
  const std::vector<std::optional<float>> none(d.draws.size());
  const XmlDocument doc = read_xml(derivation_diagram(*graph_, d, {}, none));
  ASSERT_EQ(doc.fault, "");
  EXPECT_THAT(doc.texts(), Contains(HasSubstr("base u 0.25")));
}

// Chains whose length is exact: one slot a gene.
Derivation chain_of(const GeneratorGraph& graph, std::size_t genes) {
  RandomStream random({3, Purpose::test, 0, 0, 0});
  Derivation d = seedling(graph, random);
  d.slots.assign(1, SlotState::filled);
  d.genes[0].genes_below = static_cast<std::uint32_t>(genes - 1);
  d.genes[0].slots_below = static_cast<std::uint32_t>(genes - 1);
  for (std::size_t g = 1; g < genes; ++g) {
    const auto below = static_cast<std::uint32_t>(genes - 1 - g);
    d.genes.push_back({static_cast<EdgeId>(g == 1 ? 1 : 2), 0, below, below, 0});
    d.slots.push_back(below > 0 ? SlotState::filled : SlotState::empty);
  }
  return d;
}

TEST(DerivationDiagramSizes, LargeDerivationsAreDotsAndVeryLargeOnesAreCutWithANote) {
  const std::string text = "grammar chain 1 start A rule A { spawn B } rule B { emit box maybe 0.5 spawn B }";
  const auto graph = compile_grammar({"chain.esp", text, {}}).graph;
  ASSERT_TRUE(graph);
  const auto drawn = [&](std::size_t genes) {
    const Derivation d = chain_of(*graph, genes);
    const XmlDocument doc = read_xml(derivation_diagram(*graph, d, {}, {}));
    EXPECT_EQ(doc.fault, "");
    return doc;
  };
  const auto genes_in = [](const XmlDocument& doc) {
    std::size_t genes = 0;
    for (const std::string& hint : doc.texts("title")) genes += hint.starts_with("gene ");
    return genes;
  };
  EXPECT_EQ(drawn(kMostBoxedGenes).texts().count("B"), kMostBoxedGenes - 1);
  const XmlDocument dots = drawn(kMostBoxedGenes + 1);
  EXPECT_EQ(dots.texts().count("B"), 0u);
  EXPECT_EQ(dots.texts().count("B 200"), 1u) << "the legend";
  EXPECT_EQ(genes_in(dots), kMostBoxedGenes + 1);
  EXPECT_EQ(genes_in(drawn(kMostDrawnGenes)), kMostDrawnGenes);
  const XmlDocument cut = drawn(kMostDrawnGenes + 123);
  EXPECT_EQ(genes_in(cut), kMostDrawnGenes);
  EXPECT_THAT(cut.texts(), Contains(HasSubstr("123 are left out")));
}

TEST_F(DerivationDiagram, TheSameDerivationGivesTheSameBytes) {
  EXPECT_EQ(svg(grown(30)), svg(grown(30)));
  EXPECT_EQ(svg(grown(300)), svg(grown(300)));
}

}  // namespace
}  // namespace espalier
