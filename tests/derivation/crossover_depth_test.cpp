#include <gtest/gtest.h>

#include "chi_square.h"
#include "crossover_outcomes.h"
#include "derivation/crossover.h"
#include "enumerate.h"

namespace espalier {
namespace {

using namespace test;

constexpr SlotState E = SlotState::empty, F = SlotState::filled, A = SlotState::absent;

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
  for (std::uint32_t i = 1; i <= n; ++i) {
    d.genes.push_back({static_cast<EdgeId>(i == 1 ? 1 : 2), 0, n - i, n - i, n - i});
  }
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

}  // namespace
}  // namespace espalier
