#include <gtest/gtest.h>

#include "chi_square.h"
#include "derivation/moves.h"
#include "move_outcomes.h"

namespace espalier {
namespace {

using namespace test;

/// One gene with three variants over slots {X required, Y optional, Z optional, X again}: lists share and lack some.
Fixture choice() {
  GraphBuilder b("choice");
  const RuleId root = b.rule("Root", 2), x = b.rule("X"), y = b.rule("Y", 1), z = b.rule("Z");
  b.spawn(root, x);
  b.maybe(root, y, 0.5);
  b.maybe(root, z, 0.5);
  b.variant(root, 0.5, {0}, {0, 1});
  b.variant(root, 0.3, {0, 1}, {1, 2});
  b.variant(root, 0.2, {}, {0, 2});
  Fixture f{b.build(), {}};
  // variant 2: Y filled (draw 5), Z filled
  f.start = {{{0, 1, 2, 0, 1}, {2, 0, 0, 0, 0}, {3, 0, 0, 0, 0}}, {F, F}, {1, 2, 5}, 9};
  EXPECT_EQ(find_fault(f.graph, f.start), "");
  return f;
}

TEST(Alter, KeepsCommonSlotsCutsLostOnesAndGrowsRequiredOnes) {
  const Fixture f = choice();
  RandomStream random = stream(13);
  std::map<std::string, int> counts;
  for (int i = 0; i < 30000; ++i) {
    Derivation d = f.start;
    ASSERT_TRUE(alter(f.graph, d, {}, random));
    ASSERT_EQ(find_fault(f.graph, d), "");
    const std::string key = std::to_string(d.genes[0].variant) + states(d);
    const bool y_altered = !d.draws.empty() && d.draws.back() != 5;
    if (d.genes[0].variant == 0) {
      EXPECT_EQ(d.draws.back(), 5u);  // Y came along
      EXPECT_EQ(d.genes[2].edge, 2);
    }
    ++counts[key + (d.genes[0].variant == 1 && y_altered ? "y" : "")];
  }
  // Root and Y have something to alter: 1/2 each
  expect_distribution({{"1FFy", 0.5}, {"0FF", 0.25}, {"1FF", 0.15}, {"2FF", 0.1}}, counts);
}

TEST(Alter, GainedOptionalSlotsAreEmpty) {
  Fixture f = choice();
  f.start = {{{0, 0, 1, 0, 0}, {1, 0, 0, 0, 0}}, {F, E}, {1}, 9};  // variant 1: X, no Y
  ASSERT_EQ(find_fault(f.graph, f.start), "");
  expect_distribution({{"FE", 0.7}, {"EE", 0.3}}, outcomes(f, alter, {}, 10000, 14));
}

TEST(Alter, VariantsThatLoseALockedChildAreNotPicked) {
  const Fixture f = choice();
  RandomStream random = stream(15);
  const Locks locks = {{{1}, LockScope::draws}};  // Y: in variants 1 and 2
  std::vector<int> counts(3);
  for (int i = 0; i < 20000; ++i) {
    Derivation d = f.start;
    ASSERT_TRUE(alter(f.graph, d, locks, random));
    ++counts[d.genes[0].variant];
    ASSERT_EQ(d.draws.back(), 5u);
  }
  expect_distribution({0.5 / 0.8, 0.3 / 0.8, 0}, counts);
}

TEST(Alter, DrawsAreFreshAndUniform) {
  const Fixture f = flat({F, E, E, F});
  RandomStream random = stream(16);
  std::vector<int> bins(8);
  for (int i = 0; i < 8000; ++i) {
    Derivation d = f.start;
    ASSERT_TRUE(alter(f.graph, d, {}, random));  // only A has a draw
    ++bins[d.draws[0] >> 29];
  }
  expect_distribution(std::vector<double>(8, 0.125), bins);
}

TEST(Alter, FindsNothingToAlter) {
  Fixture f = flat({E, F, E, F});
  RandomStream random = stream(17);
  EXPECT_FALSE(alter(f.graph, f.start, {}, random));
  Fixture g = flat({F, E, E, F});
  EXPECT_FALSE(alter(g.graph, g.start, {{{0}, LockScope::draws}}, random));
  EXPECT_TRUE(alter(g.graph, g.start, {{{}, LockScope::structure}}, random));
}

TEST(Alter, LocksOfStructureKeepTheVariant) {
  Fixture f = choice();
  RandomStream random = stream(18);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(alter(f.graph, f.start, {{{}, LockScope::structure}}, random));
    EXPECT_EQ(f.start.genes[0].variant, 1);
  }
}

}  // namespace
}  // namespace espalier
