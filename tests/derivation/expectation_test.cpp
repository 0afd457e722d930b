#include "derivation/expectation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "enumerate.h"
#include "random_graph.h"

namespace espalier {
namespace {

using namespace test;

TEST(Expectation, OfAChainIsAGeometricSeries) {
  GraphBuilder b("chain");
  const RuleId s = b.rule("S"), a = b.rule("A");
  b.spawn(s, a);
  b.maybe(a, a, 0.75);
  const auto expected = expected_genes(b.build());
  ASSERT_TRUE(expected);
  EXPECT_NEAR((*expected)[s], 1, 1e-12);
  EXPECT_NEAR((*expected)[a], 4, 1e-9);
}

TEST(Expectation, WeighsVariantsAndSlots) {
  // A has two variants, 1/4 and 3/4; only the second has the two slots, each filled with 0.3.
  GraphBuilder b("variants");
  const RuleId s = b.rule("S"), a = b.rule("A");
  b.spawn(s, a);
  b.maybe(a, a, 0.3, 2);
  b.variant(a, 0.25, {}, {});
  b.variant(a, 0.75, {}, {0, 1});
  const auto expected = expected_genes(b.build());
  ASSERT_TRUE(expected);
  EXPECT_NEAR((*expected)[a], 1 / (1 - 0.75 * 2 * 0.3), 1e-9);
}

TEST(Expectation, IsUnknownWhereGenesGrowWithoutEnd) {
  GraphBuilder b("more");
  const RuleId s = b.rule("S"), a = b.rule("A");
  b.spawn(s, a);
  b.maybe(a, a, 0.6, 2);
  EXPECT_FALSE(expected_genes(b.build()));
}

TEST(Expectation, AgreesWithEveryDerivationOfGuardedGraphs) {
  int compared = 0;
  for (int deep = 2; deep <= 4; ++deep) {
    for (const bool by_rule : {false, true}) {
      GraphBuilder b("guarded");
      const RuleId s = b.rule("S"), a = b.rule("A"), c = b.rule("C");
      b.spawn(s, a);
      b.maybe(a, a, by_depth(2, 0.6, 0.2));
      b.maybe(a, c, 0.3);
      b.maybe(c, a, 0.5);
      if (by_rule) b.guard(a, count_below(b.count(a), deep - 1));
      else b.guard(a, depth_below(deep));
      b.guard(c, depth_below(deep));
      b.variant(a, by_depth(2, 0.25, 0.5), {}, {0, 1});
      b.variant(a, by_depth(2, 0.75, 0.5), {}, {1});
      const GeneratorGraph graph = b.build();
      const Enumeration all(graph);
      std::vector<double> mean(graph.rules.size(), 0);
      double mass = 0;
      for (const Enumerated& one : all.all()) {
        mass += one.probability;
        for (const auto& [rule, genes] : one.genes) mean[rule] += one.probability * genes;
      }
      ASSERT_NEAR(mass, 1, 1e-9);
      const auto expected = expected_genes(graph);
      ASSERT_TRUE(expected);
      for (std::size_t r = 0; r < mean.size(); ++r) EXPECT_NEAR((*expected)[r], mean[r], 1e-9) << graph.rules[r].name;
      const auto counts = count_derivations(graph);
      ASSERT_FALSE(counts.empty());
      EXPECT_EQ(counts.back().count, static_cast<double>(all.all().size()));
      ++compared;
    }
  }
  EXPECT_EQ(compared, 6);
}

TEST(Expectation, CountsDerivationsByTheirLevels) {
  // A binary tree: f(1) = 1, f(n + 1) = (1 + f(n))^2.
  GraphBuilder b("binary");
  const RuleId a = b.rule("A");
  b.maybe(a, a, 0.4, 2);
  const auto counts = count_derivations(b.build());
  ASSERT_GE(counts.size(), 4u);
  EXPECT_EQ(counts[0].count, 1);
  EXPECT_EQ(counts[1].count, 4);
  EXPECT_EQ(counts[2].levels, 4u);
  EXPECT_EQ(counts[2].count, 676);
  EXPECT_TRUE(std::isinf(counts.back().count));
}

TEST(Expectation, WhatRequiresMoreThanThereIsRoomForIsNotCounted) {
  GraphBuilder b("required");
  const RuleId s = b.rule("S"), a = b.rule("A");
  b.spawn(s, a);
  const auto counts = count_derivations(b.build());
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_EQ(counts[0].count, 0);
  EXPECT_EQ(counts[1].count, 1);
}

TEST(Expectation, RandomGraphsEndWithinTheirSteps) {
  int known = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    RandomStream random({5, Purpose::test, 0, i, 0});
    const GeneratorGraph graph = random_graph(random);
    known += expected_genes(graph).has_value();
    for (const DerivationCount& count : count_derivations(graph)) EXPECT_GE(count.count, 0);
  }
  EXPECT_GT(known, 20);
}

}  // namespace
}  // namespace espalier
