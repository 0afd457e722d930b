#pragma once
// What crossing two derivations comes to.

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "random_derivation.h"

namespace espalier::test {

/// Swaps many times and counts the draws of both children.
inline std::map<std::string, int> outcomes(const GeneratorGraph& graph, const Derivation& p1, const Derivation& p2,
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

}  // namespace espalier::test
