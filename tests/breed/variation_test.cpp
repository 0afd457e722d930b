#include "breed/variation.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"
#include "breed/alignment.h"
#include "breed/newcomer.h"
#include "derivation/encode.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;

RandomStream stream(std::uint32_t i) { return RandomStream({4, Purpose::test, 0, i, 0}); }

std::pair<Derivation, Derivation> two_newcomers(const GeneratorGraph& graph, RandomStream& random) {
  return {draw_newcomer(graph, random), draw_newcomer(graph, random)};
}

const char* const kGrammars[] = {"gentree.esp", "gentree-natural.esp", "spaceship.esp", "tree-v2.esp", "plant.esp"};

TEST(Variation, EveryChildIsAValidDerivation) {
  for (const char* name : kGrammars) {
    const auto graph = test::compile_shipped(name);
    for (std::uint32_t i = 0; i < 60; ++i) {
      RandomStream random = stream(i);
      const Derivation a = draw_newcomer(*graph, random), b = draw_newcomer(*graph, random),
                       c = draw_newcomer(*graph, random);
      const Derivation* three[] = {&a, &b, &c};
      const double weights[] = {random.next_unit(), random.next_unit(), 0.1};
      Derivation leaning = a;
      lean(*graph, b, c, 0.7, {}, leaning);
      for (const Derivation& child :
           {mutate(*graph, a, {}, random.next_unit(), random), cross(*graph, a, b, {}, random),
            blend(*graph, three, weights, {}), make_sibling(*graph, a, {}, random.next_unit(), random), leaning}) {
        ASSERT_EQ(find_fault(*graph, child), "") << name;
        for (const SlotState slot : child.slots) ASSERT_NE(slot, SlotState::open);
      }
    }
  }
}

TEST(Variation, MutationAlwaysChangesSomethingAndTheDialIsADial) {
  const auto graph = test::compile_shipped("gentree.esp");
  double last = 0;
  for (const double strength : {0.0, 0.25, 0.5, 1.0}) {
    double moved = 0;
    for (std::uint32_t i = 0; i < 400; ++i) {
      RandomStream random = stream(i);
      const Derivation parent = draw_newcomer(*graph, random), child = mutate(*graph, parent, {}, strength, random);
      EXPECT_NE(child.draws, parent.draws);
      for (std::size_t k = 0; k < 13; ++k) moved += std::abs(child.draws[k] * 0x1p-32 - parent.draws[k] * 0x1p-32);
    }
    EXPECT_GT(moved, 1.5 * last) << strength;
    last = moved;
  }
}

TEST(Variation, StepsAreBellShapedAndAsWideAsAsked) {
  const DrawComponent draw{"d", DrawShape::continuous, 0};
  double sum = 0, square = 0;
  constexpr int kSteps = 20'000;
  RandomStream random = stream(1);
  for (int i = 0; i < kSteps; ++i) {
    const double step = step_quantile(0x80000000u, draw, 0.1, random) * 0x1p-32 - 0.5;
    EXPECT_LT(std::abs(step), 0.35);
    sum += step, square += step * step;
  }
  EXPECT_NEAR(sum / kSteps, 0, 4 * 0.1 / std::sqrt(kSteps));
  EXPECT_NEAR(std::sqrt(square / kSteps), 0.1, 0.003);
  const DrawComponent few{"n", DrawShape::discrete, 3};
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t before = random.next_u32(), after = step_quantile(before, few, 0.01, random);
    EXPECT_NE(std::uint64_t{before} * 3 >> 32, std::uint64_t{after} * 3 >> 32);
  }
}

TEST(Variation, CrossingStartDrawsTakesEachFromOneOfTheTwo) {
  const auto graph = test::compile_shipped("gentree.esp");
  int from_second = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    RandomStream random = stream(i);
    const auto [a, b] = two_newcomers(*graph, random);
    const Derivation child = cross(*graph, a, b, {}, random);
    for (std::size_t k = 0; k < 13; ++k) {
      EXPECT_TRUE(child.draws[k] == a.draws[k] || child.draws[k] == b.draws[k]);
      from_second += child.draws[k] == b.draws[k];
    }
  }
  EXPECT_NEAR(from_second / 3900., 0.5, 0.04);
}

TEST(Variation, BlendIsTheWeightedMeanAndOneParentAloneIsItself) {
  const auto graph = test::compile_shipped("gentree.esp");
  RandomStream random = stream(3);
  const auto [a, b] = two_newcomers(*graph, random);
  const Derivation* two[] = {&a, &b};
  const double one_sided[] = {0, 2}, even[] = {1, 1};
  const Derivation second = blend(*graph, two, one_sided, {}), mixed = blend(*graph, two, even, {});
  for (std::size_t k = 0; k < 13; ++k) {
    const bool whole = k == 0 || k == 5;
    if (whole) {
      const auto value = [](std::uint32_t q) { return std::uint64_t{q} * 8 >> 32; };
      EXPECT_EQ(value(second.draws[k]), value(b.draws[k]));
      EXPECT_EQ(value(mixed.draws[k]), (value(a.draws[k]) + value(b.draws[k]) + 1) / 2);
    } else {
      EXPECT_EQ(second.draws[k], b.draws[k]);
      EXPECT_NEAR(mixed.draws[k], (static_cast<double>(a.draws[k]) + b.draws[k]) / 2, 1);
    }
  }
}

TEST(Variation, LeaningGoesTheWayFromTheWorseToTheBetter) {
  const auto graph = test::compile_shipped("gentree.esp");
  RandomStream random = stream(3);
  Derivation child = draw_newcomer(*graph, random), better = child, worse = child;
  better.draws[3] = 0xc0000000, worse.draws[3] = 0x40000000;
  better.draws[4] = 0xffffffff, worse.draws[4] = 0;
  child.draws[3] = 0x20000000, child.draws[4] = 0xf0000000;
  const Derivation before = child;
  Held held;
  lean(*graph, better, worse, 0.5, held, child);
  EXPECT_EQ(child.draws[3], 0x60000000u);
  EXPECT_EQ(child.draws[4], 0xffffffffu) << "stops at the end";
  EXPECT_EQ(child.draws[0], before.draws[0]);
}

TEST(Variation, WhatIsHeldStays) {
  for (const char* name : {"gentree.esp", "gentree-natural.esp"}) {
    const auto graph = test::compile_shipped(name);
    Held held;
    held.draws = {{{}, 2}, {{}, 12}};
    for (std::uint32_t i = 0; i < 200; ++i) {
      RandomStream random = stream(i);
      const auto [a, b] = two_newcomers(*graph, random);
      const Derivation* two[] = {&a, &b};
      const double weights[] = {0.2, 0.8};
      Derivation leaning = a;
      lean(*graph, b, a, 1, held, leaning);
      for (const Derivation& child :
           {mutate(*graph, a, held, 1, random), cross(*graph, a, b, held, random), blend(*graph, two, weights, held),
            make_sibling(*graph, a, held, 1, random), draw_newcomer(*graph, a, held, random), leaning}) {
        EXPECT_EQ(child.draws[2], a.draws[2]);
        EXPECT_EQ(child.draws[12], a.draws[12]);
      }
    }
    Held all;
    all.genes = {{{}, LockScope::draws}};
    RandomStream random = stream(1);
    const Derivation a = draw_newcomer(*graph, random);
    EXPECT_EQ(mutate(*graph, a, all, 1, random).draws, a.draws);
  }
}

TEST(Variation, LockedSubtreesStayInTreesOfGenes) {
  const auto graph = test::compile_shipped("spaceship.esp");
  int locked = 0;
  for (std::uint32_t i = 0; i < 150; ++i) {
    RandomStream random = stream(i);
    const auto [a, b] = two_newcomers(*graph, random);
    if (a.size() < 3) continue;
    const std::uint32_t gene = 1 + random.below(static_cast<std::uint32_t>(a.size()) - 1);
    Held held;
    held.genes = {{gene_path(*graph, a, gene), LockScope::subtree}};
    GenePath path;
    locate(*graph, a, gene, path);
    const SubtreeSlice before = subtree_at(*graph, a, path.gene);
    const Derivation* two[] = {&a, &b};
    const double weights[] = {0.3, 0.7};
    for (const Derivation& child : {mutate(*graph, a, held, 1, random), cross(*graph, a, b, held, random),
                                    blend(*graph, two, weights, held), make_sibling(*graph, a, held, 1, random),
                                    draw_newcomer(*graph, a, held, random)}) {
      const auto found = find_gene(*graph, child, held.genes[0].path);
      ASSERT_TRUE(found);
      locate(*graph, child, *found, path);
      const SubtreeSlice after = subtree_at(*graph, child, path.gene);
      ASSERT_EQ(after.genes, before.genes);
      EXPECT_TRUE(std::equal(a.draws.begin() + before.begin.draw, a.draws.begin() + before.begin.draw + before.draws,
                             child.draws.begin() + after.begin.draw));
      ++locked;
    }
  }
  EXPECT_GT(locked, 300);
}

TEST(DrawLocks, LocksThatLeadNowhereAreRefused) {
  const auto graph = test::compile_shipped("gentree.esp");
  const auto error_of = [&](const Held& held) -> std::string {
    try {
      validate(*graph, held);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  Held held;
  held.draws = {{{}, 13}};
  EXPECT_THAT(error_of(held), HasSubstr("rule Tree has 13 draws, there is no draw 13"));
  held.draws = {{{4}, 0}};
  EXPECT_THAT(error_of(held), HasSubstr("rule Tree has 0 slots, there is no slot 4"));
  held.draws = {{{}, 12}};
  EXPECT_EQ(error_of(held), "accepted");
}

TEST(Alignment, ADerivationAlignsWithItselfWhole) {
  const auto graph = test::compile_shipped("spaceship.esp");
  for (std::uint32_t i = 0; i < 20; ++i) {
    RandomStream random = stream(i);
    const Derivation a = draw_newcomer(*graph, random);
    const auto aligned = align(*graph, a, a);
    EXPECT_EQ(aligned.size(), a.size());
    for (const AlignedGene& gene : aligned) EXPECT_EQ(gene.first.draw, gene.second.draw);
  }
}

}  // namespace
}  // namespace espalier
