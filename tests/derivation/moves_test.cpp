#include "derivation/moves.h"

#include <gtest/gtest.h>

#include "chi_square.h"
#include "move_outcomes.h"

namespace espalier {
namespace {

using namespace test;

/// Applies moves at random to derivations of random graphs under random locks.
void check_move(Move move, std::uint64_t first_seed) {
  int made = 0, refused = 0, locked = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + 500; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    std::optional<Derivation> d = random_derivation(graph, random);
    if (!d) continue;
    for (int step = 0; step < 8; ++step) {
      const Derivation before = *d;
      const Locks locks = random_locks(graph, before, random);
      locked += !locks.empty();
      const bool moved = move(graph, *d, locks, random);
      (moved ? made : refused) += 1;
      ASSERT_EQ(find_fault(graph, *d), "") << "seed " << seed << " step " << step;
      ASSERT_TRUE(moved || *d == before) << "seed " << seed;
      EXPECT_EQ(d->detail_seed, before.detail_seed);
      expect_locks_kept(graph, before, *d, locks);
      if (testing::Test::HasFailure()) FAIL() << "seed " << seed << " step " << step;
    }
  }
  EXPECT_GT(made, 1000);
  EXPECT_GT(refused, 50);
  EXPECT_GT(locked, 1000);
}

TEST(Grow, StaysValidAndKeepsLocks) { check_move(grow, 1000); }
TEST(Cut, StaysValidAndKeepsLocks) { check_move(cut, 2000); }
TEST(Alter, StaysValidAndKeepsLocks) { check_move(alter, 3000); }

TEST(Moves, MixedForLongStayValid) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    RandomStream random = stream(seed + 9000);
    const GeneratorGraph graph = seed % 2 ? guarded_tree() : random_graph(random);
    std::optional<Derivation> d = random_derivation(graph, random);
    if (!d) continue;
    for (int step = 0; step < 60; ++step) {
      constexpr Move kMoves[] = {grow, grow, cut, alter};
      kMoves[random.below(4)](graph, *d, {}, random);
      ASSERT_EQ(find_fault(graph, *d), "") << "seed " << seed << " step " << step;
    }
  }
}

TEST(Grow, PicksEmptySlotsInProportionToP) {
  const Fixture f = flat({E, E, E, F});
  expect_distribution({{"FEEF", 5.0 / 9}, {"EFEF", 2.0 / 9}, {"EEFF", 2.0 / 9}}, outcomes(f, grow, {}, 20000, 1));
}

TEST(Cut, PicksFilledOptionalSlotsInProportionToOneMinusP) {
  const Fixture f = flat({F, F, F, F});
  expect_distribution({{"EFFF", 5.0 / 21}, {"FEFF", 8.0 / 21}, {"FFEF", 8.0 / 21}}, outcomes(f, cut, {}, 20000, 2));
}

TEST(Cut, LeavesRequiredAndLockedGenes) {
  const Fixture f = flat({F, F, E, F});
  expect_distribution({{"EFEF", 5.0 / 13}, {"FEEF", 8.0 / 13}}, outcomes(f, cut, {}, 10000, 3));
  const Locks locks = {{{0}, LockScope::draws}};
  EXPECT_EQ(outcomes(f, cut, locks, 100, 4), (std::map<std::string, int>{{"FEEF", 100}}));
  Fixture bare = flat({E, E, E, F});
  RandomStream random = stream(5);
  const Derivation before = bare.start;
  EXPECT_FALSE(cut(bare.graph, bare.start, {}, random));
  EXPECT_EQ(bare.start, before);
}

TEST(Grow, FindsNothingWhereAllIsFull) {
  Fixture f = flat({F, F, F, F});
  RandomStream random = stream(5);
  EXPECT_FALSE(grow(f.graph, f.start, {}, random));
}

TEST(Grow, LeavesSlotsOfLockedStructure) {
  Fixture f = flat({E, E, E, F});
  RandomStream random = stream(6);
  EXPECT_FALSE(grow(f.graph, f.start, {{{}, LockScope::structure}}, random));
  EXPECT_FALSE(grow(f.graph, f.start, {{{}, LockScope::subtree}}, random));
  EXPECT_TRUE(grow(f.graph, f.start, {{{}, LockScope::draws}}, random));
}

TEST(Grow, UsesPAtTheDepthOfTheParent) {
  GraphBuilder b("chain");
  const RuleId root = b.rule("Root"), link = b.rule("Link");
  b.maybe(root, link, 0.5, 2);
  b.maybe(link, link, by_depth(2, 0.25, 0.75));
  Fixture f{b.build(), {}};
  // Root - (Link(depth 1) - Link(depth 2), empty); slots in order: Root 0, Root 1, Link, Link
  f.start = {{{0, 0, 2, 2, 0}, {1, 0, 1, 1, 0}, {2, 0, 0, 0, 0}}, {F, E, F, E}, {}, 0};
  ASSERT_EQ(find_fault(f.graph, f.start), "");
  expect_distribution({{"FFFEE", 0.5 / 1.25}, {"FEFFE", 0.75 / 1.25}}, outcomes(f, grow, {}, 20000, 7));
  // and cut by 1 - p: Link at depth 1 has p 0.5, the one below it 0.25
  expect_distribution({{"EE", 0.5 / 1.25}, {"FEE", 0.75 / 1.25}}, outcomes(f, cut, {}, 20000, 8));
}

/// Root with two optional slots of Box, which picks: 1/4 plain, 3/4 with a required Lid.
Fixture boxes(std::optional<std::uint32_t> most_lids, double p1, double p2) {
  GraphBuilder b("boxes");
  const RuleId root = b.rule("Root"), box = b.rule("Box", 1), lid = b.rule("Lid");
  b.maybe(root, box, p1);
  b.maybe(root, box, p2);
  b.spawn(box, lid);
  b.maybe(box, lid, 0.5);
  b.variant(box, 0.25, {}, {1});
  b.variant(box, 0.75, {0}, {0, 1});
  if (most_lids) b.limit(lid, *most_lids);
  Fixture f{b.build(), {}};
  f.start = {{{0, 0, 0, 0, 0}}, {E, E}, {}, 0};
  EXPECT_EQ(find_fault(f.graph, f.start), "");
  return f;
}

TEST(Grow, PicksVariantsByWeightAndGrowsWhatIsRequired) {
  const Fixture f = boxes({}, 0.3, 0.6);
  expect_distribution({{"FEE", 1 / 12.0}, {"FEFE", 3 / 12.0}, {"EFE", 2 / 12.0}, {"EFFE", 6 / 12.0}},
                      outcomes(f, grow, {}, 20000, 9));
}

TEST(Grow, IsConditionedOnLimits) {
  const Fixture none = boxes(0, 0.3, 0.6);
  expect_distribution({{"FEE", 1 / 3.0}, {"EFE", 2 / 3.0}}, outcomes(none, grow, {}, 20000, 10));
}

TEST(Grow, RefusesWhatHasNoEnd) {
  GraphBuilder b("endless");
  const RuleId root = b.rule("Root"), link = b.rule("Link");
  b.maybe(root, link, 0.5);
  b.spawn(link, link);
  Fixture f{b.build(), {{{0, 0, 0, 0, 0}}, {E}, {}, 0}};
  RandomStream random = stream(11);
  const Derivation before = f.start;
  EXPECT_FALSE(grow(f.graph, f.start, {}, random));
  EXPECT_EQ(f.start, before);
}

TEST(Grow, EndsRequiredRecursionAtItsGuard) {
  GraphBuilder b("ends");
  const RuleId root = b.rule("Root"), link = b.rule("Link");
  b.maybe(root, link, 0.5);
  b.spawn(link, link);
  b.guard(link, depth_below(4));
  Fixture f{b.build(), {{{0, 0, 0, 0, 0}}, {E}, {}, 0}};
  RandomStream random = stream(12);
  ASSERT_TRUE(grow(f.graph, f.start, {}, random));
  EXPECT_EQ(states(f.start), "FFFA");
}

TEST(Moves, AbsentSlotsStayAbsent) {
  GraphBuilder b("shallow");
  const RuleId root = b.rule("Root", 1), link = b.rule("Link", 1);
  b.maybe(root, link, 0.5);
  b.maybe(link, link, 0.5);
  b.guard(link, depth_below(2));
  Fixture f{b.build(), {{{0, 0, 1, 1, 1}, {1, 0, 0, 0, 0}}, {F, A}, {1, 2}, 0}};
  ASSERT_EQ(find_fault(f.graph, f.start), "");
  RandomStream random = stream(19);
  EXPECT_FALSE(grow(f.graph, f.start, {}, random));
}

}  // namespace
}  // namespace espalier
