#pragma once
// Generator graphs at random, from which property tests draw.

#include <string>
#include <vector>

#include "base/random.h"
#include "derivation/test_graph.h"

namespace espalier::test {

/// Spawns at random; returns the number of slots per rule. What is required always ends.
inline std::vector<std::uint16_t> add_random_edges(GraphBuilder& b, const std::vector<bool>& guarded,
                                                   RandomStream& random) {
  const std::uint32_t rules = static_cast<std::uint32_t>(guarded.size());
  std::vector<std::uint16_t> slots(rules);
  for (std::uint32_t r = 0; r < rules; ++r) {
    const RuleId parent = static_cast<RuleId>(r);
    for (std::uint32_t edges = random.below(4) + (r == 0 ? 1 : 0); edges > 0; --edges) {
      const RuleId child = static_cast<RuleId>(1 + random.below(rules - 1));
      const int copies = 1 + static_cast<int>(random.below(2));
      const double p = 0.1 + 0.7 * random.next_unit();
      const bool ends = guarded[child] ? copies == 1 : child > r;
      if (ends && random.chance(0.3)) {
        b.spawn(parent, child, copies);
      } else {
        b.maybe(parent, child, random.chance(0.2) ? by_depth(3, p, 0.5 * p) : DepthValue(p), copies);
      }
      slots[r] = static_cast<std::uint16_t>(slots[r] + copies);
    }
  }
  return slots;
}

/// Variants that share and lack draws and slots, some with weights by depth.
inline void add_random_variants(GraphBuilder& b, RuleId rule, std::size_t draws, std::uint16_t slots,
                                RandomStream& random) {
  const std::uint32_t variants = 2 + random.below(3);
  for (std::uint32_t v = 0; v < variants; ++v) {
    std::vector<std::uint16_t> own_draws, own_slots;
    for (std::uint16_t d = 0; d < draws; ++d) {
      if (random.chance(0.6)) own_draws.push_back(d);
    }
    for (std::uint16_t s = 0; s < slots; ++s) {
      if (random.chance(0.7)) own_slots.push_back(s);
    }
    const bool by = variants == 2 && random.chance(0.3);  // at depth >= 4 only the second is left
    b.variant(rule, by ? by_depth(4, 0.5, v == 0 ? 0 : 1) : DepthValue(1.0 / variants), own_draws, own_slots);
  }
}

/// A graph in which anything may happen: guards by depth and by depth of a rule, limits, choices whose variants share
/// and lack draws and slots, weights and probabilities by depth, required recursion that a guard ends. The start rule
/// is never spawned.
inline GeneratorGraph random_graph(RandomStream& random) {
  GraphBuilder b("random");
  const std::uint32_t rules = 2 + random.below(5);
  std::vector<std::size_t> draws;
  for (std::uint32_t r = 0; r < rules; ++r) {
    draws.push_back(random.below(4));
    b.rule("R" + std::to_string(r), static_cast<int>(draws.back()));
  }
  std::vector<bool> guarded(rules);
  for (std::uint32_t r = 1; r < rules; ++r) {
    const RuleId rule = static_cast<RuleId>(r);
    guarded[r] = random.chance(0.5);
    if (guarded[r]) {
      const double most = 2 + random.below(5);
      b.guard(rule, random.chance(0.7) ? depth_below(most) : count_below(b.count(rule), most));
    }
    if (random.chance(0.2)) b.limit(rule, 1 + random.below(6));
  }
  const std::vector<std::uint16_t> slots = add_random_edges(b, guarded, random);
  for (std::uint32_t r = 0; r < rules; ++r) {
    if (random.chance(0.4)) add_random_variants(b, static_cast<RuleId>(r), draws[r], slots[r], random);
  }
  return b.build();
}

}  // namespace espalier::test
