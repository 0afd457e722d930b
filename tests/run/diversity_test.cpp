#include "run/diversity.h"

#include <gtest/gtest.h>

#include "derivation/moves.h"
#include "derivation/sample.h"
#include "search/test_graph.h"

namespace espalier {
namespace {

using testing::twig_graph;

Derivation grown(std::uint32_t individual, std::size_t genes) {
  const auto graph = twig_graph();
  RandomStream random({5, Purpose::test, 0, individual, 0});
  Derivation d = seedling(*graph, random);
  close_open_slots(*graph, d, random);
  while (d.size() < genes && grow(*graph, d, {}, random)) {}
  return d;
}

TEST(Distance, IsAMetricInItsSimplestRespects) {
  const auto graph = twig_graph();
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Derivation a = grown(i, 5 + i), b = grown(100 + i, 30 - i);
    EXPECT_EQ(distance(*graph, a, a), 0);
    EXPECT_EQ(distance(*graph, a, b), distance(*graph, b, a));
    EXPECT_GT(distance(*graph, a, b), 0);
    EXPECT_LE(distance(*graph, a, b), 1);
  }
}

TEST(Distance, CountsPlacesByHand) {
  const auto graph = twig_graph();
  // A root with a twig in the first place; with one in both; with one in the second. Draws agree.
  const Derivation first = {{{0, 0, 1, 3, 1}, {1, 0, 0, 0, 0}},
                            {SlotState::filled, SlotState::empty, SlotState::empty, SlotState::empty, SlotState::empty},
                            {1u << 31}, 0};
  Derivation second = first;
  second.slots[0] = SlotState::empty, second.slots[1] = SlotState::filled;
  Derivation both = first;
  both.genes[0] = {0, 0, 2, 6, 2};
  both.genes.push_back({1, 0, 0, 0, 0});
  both.slots.assign(8, SlotState::empty);
  both.slots[0] = both.slots[1] = SlotState::filled;
  both.draws.push_back(1u << 31);
  EXPECT_NEAR(distance(*graph, first, second), 1 - 1 / 3., 1e-12);  // only the root is shared, of three places
  EXPECT_NEAR(distance(*graph, first, both), 1 - 2 / 3., 1e-12);
  Derivation moved = first;
  moved.draws[0] = 1u << 30;  // a quarter away
  EXPECT_NEAR(distance(*graph, first, moved), 1 - (1 + 0.75) / 2, 1e-12);
}

TEST(DiverseArchive, MembersAreSortedFarApartAndHoldTheBest) {
  const auto graph = twig_graph();
  DiverseArchive archive(*graph, 5, 0.4);
  double best = -1;
  for (std::uint32_t round = 0; round < 30; ++round) {
    std::vector<Individual> population;
    for (std::uint32_t i = 0; i < 10; ++i) population.push_back({grown(round * 10 + i, 4 + i), 0});
    for (Individual& p : population) p.score = testing::BudScorer::score_of(p.derivation);
    std::sort(population.begin(), population.end(), [](auto& a, auto& b) { return a.score > b.score; });
    best = std::max(best, population[0].score);
    archive.offer(population);
    const auto& members = archive.members();
    ASSERT_FALSE(members.empty());
    EXPECT_LE(members.size(), 5u);
    EXPECT_EQ(members[0].score, best);
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0) {
        EXPECT_LE(members[i].score, members[i - 1].score);
      }
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE(distance(*graph, members[i].derivation, members[j].derivation), 0.4);
      }
    }
  }
  EXPECT_EQ(archive.members().size(), 5u);
}

TEST(DiverseArchive, ABetterNeighbourReplacesAWorseOneAndTurnsItAway) {
  const auto graph = twig_graph();
  DiverseArchive archive(*graph, 5, 0.5);
  const Derivation a = grown(1, 12);
  Derivation b = a;
  RandomStream random({6, Purpose::test});
  ASSERT_TRUE(alter(*graph, b, {}, random));
  archive.offer(std::vector<Individual>{{a, 1}});
  archive.offer(std::vector<Individual>{{b, 2}});
  ASSERT_EQ(archive.members().size(), 1u);
  EXPECT_EQ(archive.members()[0].derivation, b);
  archive.offer(std::vector<Individual>{{a, 1.5}});
  ASSERT_EQ(archive.members().size(), 1u);
}

TEST(DiverseArchive, OfNoSizeKeepsNothing) {
  const auto graph = twig_graph();
  DiverseArchive archive(*graph, 0, 0.5);
  archive.offer(std::vector<Individual>{{grown(1, 5), 1}});
  EXPECT_TRUE(archive.members().empty());
}

}  // namespace
}  // namespace espalier
