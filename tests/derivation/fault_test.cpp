#include <functional>

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

constexpr SlotState O = SlotState::open, E = SlotState::empty, F = SlotState::filled, A = SlotState::absent;

/// Root - (B required, T) where T - B; B has a choice; depth < 2 for T.
GeneratorGraph small() {
  GraphBuilder b("small");
  const RuleId root = b.rule("Root", 1), base = b.rule("Base", 2), tip = b.rule("Tip");
  b.spawn(root, base);
  b.maybe(root, tip, 0.5, 2);
  b.maybe(base, tip, 0.5);
  b.maybe(tip, base, by_depth(1, 0, 0.5));
  b.guard(tip, depth_below(2));
  b.limit(base, 2);
  b.variant(base, 0.5, {0}, {});
  b.variant(base, 0.5, {0, 1}, {0});
  return b.build();
}

Derivation valid() {
  // Root, Base (variant 1: slot Tip absent at depth 2), Tip with a Base of variant 0
  return {{{0, 0, 3, 2, 3}, {1, 1, 0, 0, 0}, {2, 0, 1, 0, 1}, {4, 0, 0, 0, 0}},
          {F, F, E, A, F},
          {1, 2, 3, 4},
          5};
}

std::string fault_after(const std::function<void(Derivation&)>& change) {
  Derivation d = valid();
  change(d);
  return find_fault(small(), d);
}

TEST(FindFault, AcceptsWhatIsValid) {
  EXPECT_EQ(find_fault(small(), valid()), "");
  EXPECT_EQ(fault_after([](Derivation& d) { d.slots[2] = O; }), "");
}

TEST(FindFault, NamesWhatIsWrong) {
  EXPECT_EQ(find_fault(small(), {}), "it has no genes");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes[0].edge = 1; }),
            "gene 0: edge 1 stands in a slot of edge 0 (Root)");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes[2].edge = 3; }), "gene 2: edge 3 stands in a slot of edge 2 (Tip)");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes[3].edge = 999; }),
            "gene 3: edge 999 stands in a slot of edge 4 (Base)");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes[1].variant = 2; }), "gene 1 (Base): variant 2 of 2");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes[0].genes_below = 4; }),
            "gene 0 (Root): genes_below is 4, but 3 are below it");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes[2].slots_below = 1; }),
            "gene 2 (Tip): slots_below is 1, but 0 are below it");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes[2].draws_below = 0; }),
            "gene 2 (Tip): draws_below is 0, but 1 are below it");
  EXPECT_EQ(fault_after([](Derivation& d) { d.slots[0] = E; }), "gene 0 (Root): slot Base is required, but empty");
  EXPECT_EQ(fault_after([](Derivation& d) { d.slots[2] = A; }),
            "gene 0 (Root): slot Tip[1] is absent, but its guard holds at depth 1");
  EXPECT_EQ(fault_after([](Derivation& d) { d.slots[3] = E; }),
            "gene 1 (Base): slot Tip is not absent, but its guard fails at depth 2");
  EXPECT_EQ(fault_after([](Derivation& d) { d.slots[2] = static_cast<SlotState>(9); }),
            "gene 0 (Root): slot Tip[1] has the unknown state 9");
  EXPECT_EQ(fault_after([](Derivation& d) { d.slots.pop_back(); }), "gene 2 (Tip): its slots are missing");
  EXPECT_EQ(fault_after([](Derivation& d) { d.draws.pop_back(); }), "gene 3 (Base): its draws are missing");
  EXPECT_EQ(fault_after([](Derivation& d) { d.slots.push_back(E); }), "1 slots too many");
  EXPECT_EQ(fault_after([](Derivation& d) { d.draws.push_back(1); }), "1 draws too many");
  EXPECT_EQ(fault_after([](Derivation& d) { d.genes.push_back({4, 0, 0, 0, 0}); }),
            "gene 4: no filled slot is left for it");
}

TEST(FindFault, SeesMissingGenesAndLimits) {
  const auto cut_last = [](Derivation& d) { d.genes.pop_back(), d.draws.pop_back(); };
  EXPECT_EQ(fault_after(cut_last), "gene 2 (Tip): slot Base is filled, but its gene is missing");
  const Derivation three{
      {{0, 0, 5, 2, 4}, {1, 0, 0, 0, 0}, {2, 0, 1, 0, 1}, {4, 0, 0, 0, 0}, {2, 0, 1, 0, 1}, {4, 0, 0, 0, 0}},
      {F, F, F, F, F},
      {1, 2, 3, 4},
      0};
  EXPECT_EQ(find_fault(small(), three), "gene 5 (Base): one more than `limit 2`");
}

TEST(FindFault, SeesVariantsAndSlotsOfProbabilityZero) {
  GraphBuilder b("zero");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.maybe(root, leaf, by_depth(9, 0, 0.5));
  b.spawn(root, leaf);
  b.variant(leaf, by_depth(9, 0, 1), {}, {});
  b.variant(leaf, by_depth(9, 1, 0), {}, {});
  const GeneratorGraph graph = b.build();
  EXPECT_EQ(find_fault(graph, {{{0, 0, 2, 0, 0}, {1, 1, 0, 0, 0}, {2, 1, 0, 0, 0}}, {F, F}, {}, 0}),
            "gene 0 (Root): slot Leaf[0] is filled, but has probability 0 at depth 0");
  EXPECT_EQ(find_fault(graph, {{{0, 0, 1, 0, 0}, {2, 0, 0, 0, 0}}, {E, F}, {}, 0}),
            "gene 1 (Leaf): variant 0 has probability 0 at depth 1");
}

/// Whatever is done to a derivation, it is either told apart or a valid derivation still.
TEST(FindFault, SurvivesAnything) {
  int faults = 0, valid_still = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    std::optional<Derivation> d = random_derivation(graph, random, 20);
    if (!d) continue;
    GeneRecord& gene = d->genes[random.below(static_cast<std::uint32_t>(d->size()))];
    switch (random.below(8)) {
      case 0: gene.edge = static_cast<EdgeId>(random.below(12)); break;
      case 1: gene.variant = static_cast<std::uint16_t>(random.below(5)); break;
      case 2: gene.genes_below = random.below(2) ? random.next_u32() : random.below(5); break;
      case 3: gene.slots_below += random.below(3); break;
      case 4: gene.draws_below += random.below(3); break;
      case 5: if (!d->slots.empty()) d->slots[random.below(static_cast<std::uint32_t>(d->slots.size()))] =
                  static_cast<SlotState>(random.below(5)); break;
      case 6: d->draws.resize(random.below(static_cast<std::uint32_t>(d->draws.size() + 2))); break;
      default: d->slots.resize(random.below(static_cast<std::uint32_t>(d->slots.size() + 2))); break;
    }
    const std::string fault = find_fault(graph, *d);
    (fault.empty() ? valid_still : faults) += 1;
    EXPECT_TRUE(!fault.empty() || decode(graph, encode(graph, *d)) == *d);
  }
  EXPECT_GT(faults, 1000);
  EXPECT_GT(valid_still, 200);
}

}  // namespace
}  // namespace espalier
