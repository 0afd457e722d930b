#pragma once
// What moves come to, on derivations made by hand.

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "random_derivation.h"

namespace espalier::test {

using Move = bool (*)(const GeneratorGraph&, Derivation&, const Locks&, RandomStream&);

/// The states of all slots as letters.
inline std::string states(const Derivation& d) {
  std::string text;
  for (const SlotState state : d.slots) text += "OEFA"[static_cast<int>(state)];
  return text;
}

/// A derivation to start from.
struct Fixture {
  GeneratorGraph graph;
  Derivation start;
};

/// Root with slots A (p 0.5), B (p 0.2) twice, C (required); all leaves.
inline Fixture flat(std::vector<SlotState> slots) {
  GraphBuilder b("flat");
  const RuleId root = b.rule("Root"), leaf_a = b.rule("A", 1), leaf_b = b.rule("B"), leaf_c = b.rule("C");
  b.maybe(root, leaf_a, 0.5);
  b.maybe(root, leaf_b, 0.2, 2);
  b.spawn(root, leaf_c);
  Fixture f{b.build(), {}};
  f.start.genes.push_back({0, 0, 0, 0, 0});
  f.start.slots = slots;
  const EdgeId edges[] = {1, 2, 2, 3};
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (slots[k] != SlotState::filled) continue;
    f.start.genes.push_back({edges[k], 0, 0, 0, 0});
    if (k == 0) f.start.draws.push_back(7);
    ++f.start.genes[0].genes_below;
  }
  f.start.genes[0].draws_below = static_cast<std::uint32_t>(f.start.draws.size());
  EXPECT_EQ(find_fault(f.graph, f.start), "");
  return f;
}

inline std::map<std::string, int> outcomes(const Fixture& f, Move move, const Locks& locks, int n, std::uint64_t seed) {
  std::map<std::string, int> counts;
  RandomStream random = stream(seed);
  for (int i = 0; i < n; ++i) {
    Derivation d = f.start;
    EXPECT_TRUE(move(f.graph, d, locks, random));
    ++counts[states(d)];
  }
  return counts;
}

inline constexpr SlotState E = SlotState::empty, F = SlotState::filled, A = SlotState::absent;

}  // namespace espalier::test
