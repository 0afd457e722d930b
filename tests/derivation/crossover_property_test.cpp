#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "derivation/crossover.h"
#include "derivation/encode.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

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

}  // namespace
}  // namespace espalier
