#include "derivation/strip.h"

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "derivation/sample.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

// On random graphs: valid, no more than before, locks kept, and of the optional nothing else.
TEST(Strip, LeavesWhatIsRequiredOrLocked) {
  int smaller = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    const std::optional<Derivation> d = random_derivation(graph, random, 12);
    if (!d) continue;
    const Locks locks = random.chance(0.5) ? random_locks(graph, *d, random) : Locks{};
    const Derivation bare = stripped(graph, *d, locks);
    ASSERT_EQ(find_fault(graph, bare), "") << seed;
    EXPECT_LE(bare.size(), d->size());
    EXPECT_EQ(bare.detail_seed, d->detail_seed);
    expect_locks_kept(graph, *d, bare, locks);
    EXPECT_EQ(stripped(graph, bare, locks), bare);
    smaller += bare.size() < d->size();
    if (!locks.empty()) continue;
    for (const GeneRecord& gene : std::span(bare.genes).subspan(1)) EXPECT_TRUE(graph.edges[gene.edge].required);
  }
  EXPECT_GT(smaller, 100);
}

TEST(Reopen, OpensWhatIsEmptyAndNotLocked) {
  int opened = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    const std::optional<Derivation> d = random_derivation(graph, random, 12);
    if (!d) continue;
    Derivation open = *d;
    reopen(graph, open, {});
    ASSERT_EQ(find_fault(graph, open), "") << seed;
    for (std::size_t i = 0; i < open.slots.size(); ++i) {
      EXPECT_EQ(open.slots[i], d->slots[i] == SlotState::empty ? SlotState::open : d->slots[i]);
      opened += open.slots[i] != d->slots[i];
    }
    const Lock everything = {{}, LockScope::subtree};
    Derivation locked = *d;
    reopen(graph, locked, {everything});
    EXPECT_EQ(locked, *d);
  }
  EXPECT_GT(opened, 100);
}

}  // namespace
}  // namespace espalier
