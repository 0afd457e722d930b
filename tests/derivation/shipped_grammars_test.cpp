// The operations on derivations of every shipped grammar.

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "random_derivation.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

using namespace test;

void check_operations(const GeneratorGraph& graph, RandomStream& random) {
  Derivation p1 = sample(graph, random, 500).derivation, p2 = sample(graph, random, 500).derivation;
  ASSERT_EQ(find_fault(graph, p1), "");
  ASSERT_TRUE(close_open_slots(graph, p1, random) && close_open_slots(graph, p2, random));
  Derivation c1, c2;
  for (int step = 0; step < 20; ++step) {
    const Locks locks = random_locks(graph, p1, random);
    const Derivation before = p1;
    grow(graph, p1, locks, random), alter(graph, p1, locks, random), cut(graph, p1, locks, random);
    expect_locks_kept(graph, before, p1, locks);
    const Compatibility by = step % 2 ? Compatibility::edge : Compatibility::symbol;
    crossover(graph, p1, p2, locks, {}, {by, 3, 0.5}, random, c1, c2);
    ASSERT_EQ(find_fault(graph, c1) + find_fault(graph, c2), "");
    expect_locks_kept(graph, p1, c1, locks);
    EXPECT_EQ(c1.size() + c2.size(), p1.size() + p2.size());
    EXPECT_GT(log_prior(graph, c1), -1e300);
    std::swap(p1, c1), std::swap(p2, c2);
  }
  EXPECT_EQ(decode(graph, encode(graph, p1)), p1);
}

TEST(ShippedGrammars, TakeEveryOperation) {
  const std::vector<std::string> names = shipped_grammars();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const std::shared_ptr<const GeneratorGraph> graph = compile_shipped(name);
    ASSERT_TRUE(graph);
    for (std::uint64_t seed = 0; seed < 50 && !HasFailure(); ++seed) {
      RandomStream random = stream(seed);
      check_operations(*graph, random);
    }
  }
}

/// Edge and slot names of a compiled grammar lead back to their genes, and make entries that decode.
TEST(ShippedGrammars, NameTheirGenes) {
  const std::vector<std::string> names = shipped_grammars();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const std::shared_ptr<const GeneratorGraph> graph = compile_shipped(name);
    ASSERT_TRUE(graph);
    RandomStream random = stream(1);
    const Derivation d = sample(*graph, random, 200).derivation;
    for (std::uint32_t g = 0; g < d.size(); ++g) {
      const std::vector<std::uint16_t> path = gene_path(*graph, d, g);
      EXPECT_EQ(parse_gene_path(*graph, format_gene_path(*graph, path)), path);
    }
  }
}

}  // namespace
}  // namespace espalier
