#include "derivation/crossover.h"

#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "chi_square.h"
#include "derivation/encode.h"
#include "enumerate.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

constexpr SlotState E = SlotState::empty, F = SlotState::filled, A = SlotState::absent;

using Gene = std::tuple<RuleId, std::uint16_t, std::vector<std::uint32_t>>;

void count_genes(const GeneratorGraph& graph, const Derivation& d, int by, std::map<Gene, int>& counts) {
  auto draw = d.draws.begin();
  for (const GeneRecord& gene : d.genes) {
    const auto end = draw + static_cast<std::ptrdiff_t>(variant_of(graph, gene).draws.size());
    counts[{graph.edges[gene.edge].child, gene.variant, std::vector<std::uint32_t>(draw, end)}] += by;
    draw = end;
  }
}

void expect_conserved(const GeneratorGraph& graph, const Derivation& parent1, const Derivation& parent2,
                      const Derivation& child1, const Derivation& child2) {
  std::map<Gene, int> counts;
  count_genes(graph, parent1, 1, counts), count_genes(graph, parent2, 1, counts);
  count_genes(graph, child1, -1, counts), count_genes(graph, child2, -1, counts);
  for (const auto& [gene, count] : counts) EXPECT_EQ(count, 0) << "of rule " << std::get<0>(gene);
}

void check_random_crossovers(Compatibility compatibility, std::uint64_t first_seed) {
  int crossed = 0, locked_crossed = 0, refused = 0;
  Derivation child1, child2;
  for (std::uint64_t seed = first_seed; seed < first_seed + 700; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = seed % 4 ? random_graph(random) : guarded_tree(5);
    const std::optional<Derivation> p1 = random_derivation(graph, random), p2 = random_derivation(graph, random);
    if (!p1 || !p2) continue;
    for (int step = 0; step < 6; ++step) {
      CrossoverSettings settings{compatibility, 1 + static_cast<int>(random.below(4)), random.next_unit()};
      const Locks locks1 = random_locks(graph, *p1, random), locks2 = random_locks(graph, *p2, random);
      const CrossoverResult result =
          crossover(graph, *p1, *p2, locks1, locks2, settings, random, child1, child2);
      ASSERT_EQ(find_fault(graph, child1), "") << "seed " << seed;
      ASSERT_EQ(find_fault(graph, child2), "") << "seed " << seed;
      expect_conserved(graph, *p1, *p2, child1, child2);
      expect_locks_kept(graph, *p1, child1, locks1);
      expect_locks_kept(graph, *p2, child2, locks2);
      EXPECT_EQ(child1.detail_seed, p1->detail_seed);
      EXPECT_EQ(child2.detail_seed, p2->detail_seed);
      EXPECT_LE(result.tries, settings.retries);
      EXPECT_TRUE(result.crossed || (child1 == *p1 && child2 == *p2));
      if (testing::Test::HasFailure()) FAIL() << "seed " << seed << " step " << step;
      (result.crossed ? crossed : refused) += 1;
      locked_crossed += result.crossed && !(locks1.empty() && locks2.empty());
    }
  }
  EXPECT_GT(crossed, 1000);
  EXPECT_GT(locked_crossed, 500);
  EXPECT_GT(refused, 100);
}

TEST(Crossover, ByEdgeStaysValidConservesGenesAndKeepsLocks) { check_random_crossovers(Compatibility::edge, 1000); }
TEST(Crossover, BySymbolStaysValidConservesGenesAndKeepsLocks) { check_random_crossovers(Compatibility::symbol, 3000); }

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

/// Swaps many times and counts the draws of both children.
std::map<std::string, int> outcomes(const GeneratorGraph& graph, const Derivation& p1, const Derivation& p2,
                                    const CrossoverSettings& settings, int n, const Locks& locks1 = {},
                                    const Locks& locks2 = {}) {
  std::map<std::string, int> counts;
  RandomStream random = stream(77);
  Derivation c1, c2;
  EXPECT_EQ(find_fault(graph, p1) + find_fault(graph, p2), "");
  for (int i = 0; i < n; ++i) {
    const bool crossed = crossover(graph, p1, p2, locks1, locks2, settings, random, c1, c2).crossed;
    EXPECT_EQ(find_fault(graph, c1) + find_fault(graph, c2), "");
    std::string key = crossed ? "" : "none ";
    for (const std::uint32_t u : c1.draws) key += std::to_string(u);
    key += "|";
    for (const std::uint32_t u : c2.draws) key += std::to_string(u);
    ++counts[key];
  }
  return counts;
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

/// A chain of links that end at depth 4: Root - Link - Link - ... ; the last slot is absent at the end.
GeneratorGraph chain(bool required) {
  GraphBuilder b("chain");
  const RuleId root = b.rule("Root"), link = b.rule("Link", 1);
  b.maybe(root, link, 0.5);
  required ? b.spawn(link, link) : b.maybe(link, link, 0.5);
  b.guard(link, depth_below(4));
  return b.build();
}

Derivation links(std::vector<std::uint32_t> draws, SlotState last) {
  const std::uint32_t n = static_cast<std::uint32_t>(draws.size());
  Derivation d;
  d.genes.push_back({0, 0, n, n, n});
  for (std::uint32_t i = 1; i <= n; ++i) d.genes.push_back({static_cast<EdgeId>(i == 1 ? 1 : 2), 0, n - i, n - i, n - i});
  d.slots.assign(n, F);
  d.slots.push_back(last);
  d.draws = std::move(draws);
  return d;
}

TEST(Crossover, MovedSubtreesMeetTheGuardsOfTheirNewDepth) {
  const GeneratorGraph graph = chain(false);
  const Derivation full = links({1, 2, 3}, A), two = links({5, 6}, E);
  ASSERT_EQ(find_fault(graph, full) + find_fault(graph, two), "");
  // By edge 2: 2 or 3 of the full chain with 6 of the other. 3 comes up: its slot is empty. 6 goes down: absent.
  RandomStream random = stream(8);
  std::map<std::string, int> counts;
  Derivation c1, c2;
  for (int i = 0; i < 9000; ++i) {
    ASSERT_TRUE(crossover(graph, full, two, {}, {}, {}, random, c1, c2).crossed);
    ASSERT_EQ(find_fault(graph, c1) + find_fault(graph, c2), "");
    ++counts[key_of(graph, c1) + "/ " + key_of(graph, c2)];
  }
  expect_distribution({{"0.0F 1.0F 2.0E / 0.0F 1.0F 2.0F 2.0A ", 2 / 3.0},   // 1 with 5, 2 with 6
                       {"0.0F 1.0F 2.0F 2.0A / 0.0F 1.0F 2.0E ", 1 / 3.0}},  // 3 with 6
                      counts);
}

TEST(Crossover, DeeperThanTheGuardIsNotCompatible) {
  const GeneratorGraph graph = chain(false);
  const Derivation full = links({1, 2, 3}, A);
  // Among its like, only equal depths fit: 2 with 2 or 3 with 3, and 1 with 1.
  const std::map<std::string, int> counts = outcomes(graph, full, links({5, 6, 7}, A), {}, 9000);
  expect_distribution({{"567|123", 1 / 3.0}, {"167|523", 1 / 3.0}, {"127|563", 1 / 3.0}}, counts);
}

TEST(Crossover, RequiredSlotsMayNotTurnEmptyWhenTheyRise) {
  const GeneratorGraph graph = chain(true);
  const Derivation full = links({1, 2, 3}, A), same = links({5, 6, 7}, A);
  ASSERT_EQ(find_fault(graph, full), "");
  expect_distribution({{"567|123", 1 / 3.0}, {"167|523", 1 / 3.0}, {"127|563", 1 / 3.0}},
                      outcomes(graph, full, same, {}, 3000));
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
