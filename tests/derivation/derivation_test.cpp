#include "derivation/derivation.h"

#include <set>

#include <gtest/gtest.h>

#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

TEST(Derivation, HashSeesEveryPart) {
  const GeneratorGraph graph = spaceship();
  RandomStream random = stream(1);
  Derivation d = sample(graph, random).derivation;
  while (d.size() < 20) ASSERT_TRUE(grow(graph, d, {}, random));
  std::set<std::uint64_t> seen = {hash(d)};
  const auto expect_new = [&](const Derivation& other) { EXPECT_TRUE(seen.insert(hash(other)).second); };
  const Derivation copy = d;
  EXPECT_EQ(hash(copy), hash(d));
  for (std::size_t i = 0; i < d.draws.size(); ++i) {
    Derivation other = d;
    other.draws[i] ^= 1;
    expect_new(other);
  }
  for (std::size_t i = 0; i < d.slots.size(); ++i) {
    Derivation other = d;
    other.slots[i] = static_cast<SlotState>((static_cast<int>(other.slots[i]) + 1) % 4);
    expect_new(other);
  }
  for (std::size_t i = 0; i < d.genes.size(); ++i) {
    Derivation other = d;
    other.genes[i].variant += 1;
    expect_new(other);
    other = d;
    other.genes[i].draws_below += 1;
    expect_new(other);
  }
  Derivation other = d;
  other.detail_seed ^= 1;
  expect_new(other);
  other = d;
  other.draws.push_back(0);
  expect_new(other);
}

}  // namespace
}  // namespace espalier
