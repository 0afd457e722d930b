// Moves and crossover take no memory once their scratch and the children's storage are warm.

#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "random_derivation.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {
std::atomic<long> allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace espalier {
namespace {

using namespace test;

void reserve(Derivation& d, std::size_t genes) {
  d.genes.reserve(genes);
  d.slots.reserve(8 * genes);
  d.draws.reserve(8 * genes);
}

/// Runs the same work twice; the second time must not allocate.
template <class Work>
void expect_no_allocation(Work work) {
  work();
  const long before = allocations;
  work();
  EXPECT_EQ(allocations - before, 0);
}

TEST(Allocation, NoneInWarmOperations) {
  for (const GeneratorGraph& graph : {spaceship(), guarded_tree()}) {
    RandomStream random = stream(1);
    Derivation p1 = sample(graph, random).derivation, p2 = sample(graph, random).derivation;
    while (p1.size() < 100) ASSERT_TRUE(grow(graph, p1, {}, random));
    while (p2.size() < 100) ASSERT_TRUE(grow(graph, p2, {}, random));
    Derivation child1, child2;
    reserve(child1, 400), reserve(child2, 400);
    const Locks none, some = {{gene_path(graph, p1, 1), LockScope::draws}};
    for (const Compatibility by : {Compatibility::edge, Compatibility::symbol}) {
      expect_no_allocation([&] {
        RandomStream again = stream(2);
        for (int i = 0; i < 200; ++i) {
          crossover(graph, p1, p2, i % 2 ? none : some, none, {by, 3, 0.5}, again, child1, child2);
          grow(graph, child1, i % 2 ? none : some, again);
          cut(graph, child2, none, again);
          alter(graph, child1, some, again);
        }
      });
    }
    expect_no_allocation([&] { EXPECT_LE(log_prior(graph, p1), 0); });
  }
  EXPECT_GT(allocations, 0);
}

}  // namespace
}  // namespace espalier

#endif
