#include "derivation/crossover.h"

#include <gtest/gtest.h>

#include "chi_square.h"
#include "crossover_outcomes.h"

namespace espalier {
namespace {

using namespace test;

constexpr SlotState E = SlotState::empty, F = SlotState::filled;

/// A derivation of `graph` from edges, slots and one draw per gene; counts are filled in for a start gene with leaves.
Derivation star(const std::vector<EdgeId>& edges, std::vector<SlotState> slots, const std::vector<std::uint32_t>& draws,
                std::uint64_t detail_seed) {
  Derivation d;
  d.genes.push_back({0, 0, static_cast<std::uint32_t>(edges.size()), 0, static_cast<std::uint32_t>(draws.size())});
  for (const EdgeId edge : edges) d.genes.push_back({edge, 0, 0, 0, 0});
  d.slots = std::move(slots);
  d.draws = draws;
  d.detail_seed = detail_seed;
  return d;
}

/// Root with slots X, X (edge 1), Y (edge 2), X (edge 3, required or not); leaves with one draw.
GeneratorGraph leaves(bool last_required) {
  GraphBuilder b("leaves");
  const RuleId root = b.rule("Root"), x = b.rule("X", 1), y = b.rule("Y", 1);
  b.maybe(root, x, 0.5, 2);
  b.maybe(root, y, 0.5);
  last_required ? b.spawn(root, x) : b.maybe(root, x, 0.5);
  return b.build();
}

TEST(Crossover, PicksGenesAndMatchesUniformly) {
  const GeneratorGraph graph = leaves(false);
  // Parent 1: X1 X2 Y3 -; parent 2: X6 X7 - X8 (other edge)
  const Derivation p1 = star({1, 1, 2}, {F, F, F, E}, {1, 2, 3}, 11);
  const Derivation p2 = star({1, 1, 3}, {F, F, E, F}, {6, 7, 8}, 22);
  CrossoverSettings settings{Compatibility::edge, 1, 1};
  expect_distribution({{"623|178", 1 / 6.0}, {"723|618", 1 / 6.0}, {"163|278", 1 / 6.0}, {"173|628", 1 / 6.0},
                       {"none 123|678", 1 / 3.0}},
                      outcomes(graph, p1, p2, settings, 20000));
  settings.retries = 2;  // Y has no match: a second try helps in two of three cases
  const std::map<std::string, int> counts = outcomes(graph, p1, p2, settings, 20000);
  expect_distribution(std::vector<double>{1 / 9.0, 8 / 9.0},
                      {counts.at("none 123|678"), 20000 - counts.at("none 123|678")});
}

TEST(Crossover, ManyMatchesAreUniformToo) {
  GraphBuilder b("many");
  const RuleId root = b.rule("Root"), x = b.rule("X", 1), y = b.rule("Y", 1);
  b.maybe(root, x, 0.5, 60);
  b.maybe(root, y, 0.5, 60);
  const GeneratorGraph graph = b.build();
  std::vector<SlotState> some(120, F);
  std::vector<EdgeId> edges(60, 1);
  edges.insert(edges.end(), 60, 2);
  std::vector<std::uint32_t> draws(120);
  for (std::uint32_t i = 0; i < 120; ++i) draws[i] = i;
  const Derivation p2 = star(edges, some, draws, 0);
  std::vector<SlotState> one(120, E);
  one[0] = F;
  const Derivation p1 = star({1}, one, {1000}, 0);
  std::vector<int> counts(60);
  RandomStream random = stream(5);
  Derivation c1, c2;
  for (int i = 0; i < 20000; ++i) {
    ASSERT_TRUE(crossover(graph, p1, p2, {}, {}, {}, random, c1, c2).crossed);
    ++counts[c1.draws[0]];
  }
  expect_distribution(std::vector<double>(60, 1 / 60.0), counts);
}

TEST(Crossover, BySymbolSwapsAcrossEdges) {
  const GeneratorGraph graph = leaves(false);
  const Derivation p1 = star({1}, {F, E, E, E}, {1}, 11);
  const Derivation p2 = star({1, 1, 2, 3}, {F, F, F, F}, {5, 6, 7, 8}, 22);
  const CrossoverSettings settings{Compatibility::symbol, 1, 1};
  expect_distribution({{"5|1678", 1 / 3.0}, {"6|5178", 1 / 3.0}, {"8|5671", 1 / 3.0}},
                      outcomes(graph, p1, p2, settings, 9000));
  RandomStream random = stream(6);
  Derivation c1, c2;
  do {
    ASSERT_TRUE(crossover(graph, p1, p2, {}, {}, settings, random, c1, c2).crossed);
  } while (c1.draws[0] != 8);
  EXPECT_EQ(c1.genes[1].edge, 1);  // it stands in a slot of edge 1 now
  EXPECT_EQ(c2.genes[4].edge, 3);
}

TEST(Crossover, BySymbolFillsEmptySlots) {
  const GeneratorGraph graph = leaves(false);
  const Derivation p1 = star({1, 2}, {F, E, F, E}, {1, 2}, 11);
  const Derivation p2 = star({1}, {F, E, E, E}, {5}, 22);
  // X: the filled slot of parent 2, or one of two empty ones; Y: the empty one of its own
  const CrossoverSettings always{Compatibility::symbol, 1, 1};
  expect_distribution({{"52|1", 1 / 6.0}, {"2|51", 2 / 6.0}, {"1|52", 3 / 6.0}},
                      outcomes(graph, p1, p2, always, 12000));
  const CrossoverSettings never{Compatibility::symbol, 1, 0};
  expect_distribution({{"2|51", 0.5}, {"1|52", 0.5}}, outcomes(graph, p1, p2, never, 8000));
  const CrossoverSettings half{Compatibility::symbol, 1, 0.5};
  expect_distribution({{"52|1", 0.5 * 0.5 / 3}, {"2|51", 0.5 * (1 - 0.5 / 3)}, {"1|52", 0.5}},
                      outcomes(graph, p1, p2, half, 12000));
}

TEST(Crossover, BySymbolNeverEmptiesARequiredSlot) {
  const GeneratorGraph graph = leaves(true);
  const Derivation p1 = star({3}, {E, E, E, F}, {1}, 11);
  const Derivation p2 = star({1, 3}, {F, E, E, F}, {5, 6}, 22);
  // There is an empty slot beside the first match, but it cannot take a subtree whose slot is required.
  const CrossoverSettings never{Compatibility::symbol, 1, 0};
  expect_distribution({{"5|16", 0.5}, {"6|51", 0.5}}, outcomes(graph, p1, p2, never, 8000));
}

TEST(Crossover, LocksTakePlacesAway) {
  const GeneratorGraph graph = leaves(false);
  const Derivation p1 = star({1, 1}, {F, F, E, E}, {1, 2}, 11);
  const Derivation p2 = star({1, 1}, {F, F, E, E}, {5, 6}, 22);
  const Locks first = {{{0}, LockScope::draws}}, second = {{{1}, LockScope::structure}};
  const CrossoverSettings settings{Compatibility::edge, 1, 1};
  EXPECT_EQ(outcomes(graph, p1, p2, settings, 200, first, second), (std::map<std::string, int>{{"15|26", 200}}));
  const Locks all = {{{}, LockScope::subtree}};
  EXPECT_EQ(outcomes(graph, p1, p2, settings, 50, all, {}), (std::map<std::string, int>{{"none 12|56", 50}}));
  EXPECT_EQ(outcomes(graph, p1, p2, settings, 50, {}, all), (std::map<std::string, int>{{"none 12|56", 50}}));
  // Structure held from above: no empty slot of it takes anything.
  const CrossoverSettings symbol{Compatibility::symbol, 1, 0};
  EXPECT_EQ(outcomes(graph, p1, p2, symbol, 50, {}, {{{}, LockScope::structure}}),
            (std::map<std::string, int>{{"none 12|56", 50}}));
}

TEST(Crossover, KeepsLimits) {
  GraphBuilder b("limited");
  const RuleId root = b.rule("Root"), x = b.rule("X", 1), y = b.rule("Y", 1);
  b.maybe(root, x, 0.5, 2);
  b.maybe(x, y, 0.5);
  b.limit(y, 1);
  const GeneratorGraph graph = b.build();
  // Root - (X1 - Y2, X3); Root - (X5, X6 - Y7): X3 and X6 may not change places, Y7 would come to Y2
  const Derivation p1{{{0, 0, 3, 2, 3}, {1, 0, 1, 0, 1}, {2, 0, 0, 0, 0}, {1, 0, 0, 0, 0}}, {F, F, F, E}, {1, 2, 3}, 0};
  const Derivation p2{{{0, 0, 3, 2, 3}, {1, 0, 0, 0, 0}, {1, 0, 1, 0, 1}, {2, 0, 0, 0, 0}}, {F, F, E, F}, {5, 6, 7}, 0};
  // X1: with X6 (X5 would bring a second Y to parent 2); Y2: with Y7; X3: with X5
  expect_distribution({{"673|512", 1 / 3.0}, {"173|562", 1 / 3.0}, {"125|367", 1 / 3.0}},
                      outcomes(graph, p1, p2, {Compatibility::edge, 1, 1}, 9000));
}

TEST(Crossover, WithNothingToGiveReturnsTheParents) {
  const GeneratorGraph graph = leaves(false);
  const Derivation bare = star({}, {E, E, E, E}, {}, 3), p2 = star({1}, {F, E, E, E}, {5}, 4);
  RandomStream random = stream(9);
  Derivation c1, c2;
  CrossoverResult result = crossover(graph, bare, p2, {}, {}, {}, random, c1, c2);
  EXPECT_FALSE(result.crossed);
  EXPECT_EQ(result.tries, 0);
  EXPECT_EQ(c1, bare);
  EXPECT_EQ(c2, p2);
  result = crossover(graph, p2, bare, {}, {}, {Compatibility::edge, 5, 1}, random, c1, c2);
  EXPECT_FALSE(result.crossed);
  EXPECT_EQ(result.tries, 5);
  EXPECT_EQ(c1, p2);
  EXPECT_EQ(c2, bare);
}

TEST(Crossover, OfSpaceshipsIsAFunctionOfTheStream) {
  const GeneratorGraph graph = spaceship();
  RandomStream random = stream(10);
  Derivation p1 = sample(graph, random).derivation, p2 = sample(graph, random).derivation;
  while (p1.size() < 100) ASSERT_TRUE(grow(graph, p1, {}, random));
  while (p2.size() < 150) ASSERT_TRUE(grow(graph, p2, {}, random));
  for (int i = 0; i < 300; ++i) {
    RandomStream again = random;
    Derivation c1, c2, d1, d2;
    EXPECT_TRUE(crossover(graph, p1, p2, {}, {}, {}, random, c1, c2).crossed);
    crossover(graph, p1, p2, {}, {}, {}, again, d1, d2);
    EXPECT_EQ(c1, d1);
    EXPECT_EQ(c2, d2);
    ASSERT_EQ(find_fault(graph, c1) + find_fault(graph, c2), "");
    EXPECT_EQ(c1.size() + c2.size(), p1.size() + p2.size());
    std::swap(p1, c1), std::swap(p2, c2);
  }
}

}  // namespace
}  // namespace espalier
