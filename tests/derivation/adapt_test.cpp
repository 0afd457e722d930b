#include "derivation/adapt.h"

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "derivation/sample.h"
#include "derivation/sweep.h"
#include "grammar/compiler.h"

namespace espalier {
namespace {

// A tree whose attributes decide how deep it may grow, whether it must have a root, and which alternatives exist.
std::shared_ptr<const GeneratorGraph> tree(const std::string& deepest, const std::string& rooted = "false",
                                           const std::string& fancy = "true") {
  const CompileResult result = compile_grammar({"tree.esp", R"(grammar tree 1
attr deepest in 0..20 = 12
attr rooted = false
attr fancy = true
start S
rule S { a ~ uniform(0, 1)  size a  maybe 0.99 spawn A  spawn Root }
rule A when depth <= deepest {
  b ~ uniform(0, 1)
  size b  emit box
  choose { fancy ? 1 : 1e-9 * depth: { spawn Flower } 3: { emit sphere } }
  for k in 0..1 { maybe 0.45 spawn A }
}
rule Flower when depth < 9 { c ~ uniform(0, 1)  size c  emit box }
rule Root when rooted { d ~ uniform(0, 1)  size d  emit cone }
)", {{"deepest", deepest}, {"rooted", rooted}, {"fancy", fancy}}, {}});
  EXPECT_TRUE(result.graph) << render(result.diagnostics, result.sources);
  return result.graph;
}

Derivation grown(const GeneratorGraph& graph, std::uint32_t index) {
  RandomStream random({3, Purpose::test, 0, index});
  return sample(graph, random).derivation;
}

TEST(Adapt, WhatFitsStaysAsItIs) {
  const auto graph = tree("12");
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Derivation derivation = grown(*graph, i);
    const auto adapted = adapt(*graph, derivation);
    ASSERT_TRUE(adapted);
    EXPECT_EQ(adapted->derivation, derivation);
    EXPECT_EQ(adapted->cut + adapted->grown, 0u);
  }
}

/// Draws by gene, of the genes that are at most so deep, in their order.
std::vector<std::uint32_t> draws_down_to(const GeneratorGraph& graph, const Derivation& derivation,
                                         std::uint32_t deepest) {
  std::vector<std::uint32_t> draws;
  GeneSweep sweep;
  for (sweep.begin(graph, derivation); sweep.next();) {
    const bool flower = sweep.rule().name == "Flower";  // stands one deeper than the A that holds it
    if (sweep.above().depth <= deepest + (flower ? 1 : 0)) draws.push_back(derivation.draws[sweep.position().draw]);
  }
  return draws;
}

TEST(Adapt, CutsWhatStandsTooDeepAndNothingElse) {
  const auto deep = tree("12");
  std::uint32_t cut = 0;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Derivation derivation = grown(*deep, i);
    for (const std::uint32_t deepest : {0u, 2u, 5u, 11u}) {
      const auto shallow = tree(std::to_string(deepest));
      const auto adapted = adapt(*shallow, derivation);
      ASSERT_TRUE(adapted);
      ASSERT_EQ(find_fault(*shallow, adapted->derivation), "");
      EXPECT_EQ(adapted->derivation.draws, draws_down_to(*deep, derivation, deepest));
      EXPECT_EQ(adapted->cut, derivation.size() - adapted->derivation.size());
      cut += adapted->cut;
    }
  }
  EXPECT_GT(cut, 100u);
}

TEST(Adapt, GrowsWhatIsRequiredAgain) {
  const auto without = tree("12"), with = tree("12", "true");
  const Derivation derivation = grown(*without, 1);
  const auto adapted = adapt(*with, derivation);
  ASSERT_TRUE(adapted);
  EXPECT_EQ(find_fault(*with, adapted->derivation), "");
  EXPECT_EQ(adapted->grown, 1u);
  EXPECT_EQ(adapted->derivation, adapt(*with, derivation)->derivation) << "keyed by the derivation alone";
  const auto back = adapt(*without, adapted->derivation);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->cut, 1u);
  EXPECT_EQ(back->derivation, derivation);
}

TEST(Adapt, ReadsFilesThatNeedIt) {
  const auto deep = tree("12"), shallow = tree("1");
  Derivation derivation;
  for (std::uint32_t i = 0; derivation.size() < 20; ++i) derivation = grown(*deep, i);
  const std::string text = encode(*deep, derivation);
  EXPECT_NE(find_fault(*shallow, derivation), "");
  EXPECT_EQ(find_fault(*shallow, derivation, Fit::adaptable), "");
  EXPECT_EQ(decode(*shallow, text, 1000, Fit::adaptable), derivation);
  derivation.genes[1].edge = 3;
  EXPECT_NE(find_fault(*shallow, derivation, Fit::adaptable), "") << "all but guards and probabilities must fit";
}

}  // namespace
}  // namespace espalier
