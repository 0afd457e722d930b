#include "derivation/position.h"

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "derivation/sweep.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

TEST(Position, SweepAndWalkAgreeOnEveryGene) {
  int genes = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    const std::optional<Derivation> d = random_derivation(graph, random);
    if (!d) continue;
    ASSERT_EQ(find_fault(graph, *d), "");
    GeneSweep sweep;
    GenePath path;
    std::uint32_t slots = 0, draws = 0;
    sweep.begin(graph, *d);
    for (std::uint32_t g = 0; g < d->size(); ++g, ++genes) {
      ASSERT_TRUE(sweep.next());
      locate(graph, *d, g, path);
      EXPECT_EQ(path.gene.gene, g);
      EXPECT_EQ(path.gene.slot, slots);  // prefix sums of the genes' own
      EXPECT_EQ(path.gene.draw, draws);
      EXPECT_EQ(sweep.position().gene, g);
      EXPECT_EQ(sweep.position().slot, slots);
      EXPECT_EQ(sweep.position().draw, draws);
      EXPECT_EQ(path.above.counts(), sweep.above());
      EXPECT_EQ(path.above.counts().depth, path.steps.size());
      EXPECT_EQ(sweep.below().depth, path.steps.size() + 1);
      if (g > 0) {
        EXPECT_EQ(sweep.parent(), path.steps.back().gene.gene);
        EXPECT_EQ(sweep.parent_slot(), path.steps.back().slot);
        const GenePosition again = child_in_slot(graph, *d, path.steps.back().gene, path.steps.back().slot);
        EXPECT_EQ(again.gene, g);
        EXPECT_EQ(again.draw, draws);
      }
      slots += static_cast<std::uint32_t>(variant_of(graph, d->genes[g]).slots.size());
      draws += static_cast<std::uint32_t>(variant_of(graph, d->genes[g]).draws.size());
    }
    EXPECT_FALSE(sweep.next());
    EXPECT_FALSE(sweep.next());
  }
  EXPECT_GT(genes, 3000);
}

TEST(Position, CountsGenesOfCountedRulesAbove) {
  GraphBuilder b("counts");
  const RuleId root = b.rule("Root"), a = b.rule("A"), c = b.rule("C");
  b.count(c), b.count(a);
  b.spawn(root, a);
  b.spawn(a, c);
  b.maybe(c, a, 0.5);
  const GeneratorGraph graph = b.build();
  // Root - A - C - A - C
  const Derivation d{{{0, 0, 4, 4, 0}, {1, 0, 3, 3, 0}, {2, 0, 2, 2, 0}, {3, 0, 1, 1, 0}, {2, 0, 0, 0, 0}},
                     {SlotState::filled, SlotState::filled, SlotState::filled, SlotState::filled, SlotState::empty},
                     {},
                     0};
  ASSERT_EQ(find_fault(graph, d), "");
  GenePath path;
  locate(graph, d, 4, path);
  EXPECT_EQ(path.above.counts().depth, 4u);
  EXPECT_EQ(path.above.counts().of_rule[0], 1u);  // C
  EXPECT_EQ(path.above.counts().of_rule[1], 2u);  // A
}

TEST(Position, SweepOfASubtreeStartsFromTheCountsGiven) {
  const GeneratorGraph graph = spaceship();
  RandomStream random = stream(1);
  Derivation d = sample(graph, random).derivation;
  while (d.size() < 40) ASSERT_TRUE(grow(graph, d, {}, random));
  GeneSweep sweep;
  GenePath path;
  for (std::uint32_t g = 0; g < d.size(); ++g) {
    locate(graph, d, g, path);
    sweep.begin(graph, d, path.gene, path.above.counts());
    std::uint32_t visited = 0;
    for (; sweep.next(); ++visited) {
      GenePath here;
      locate(graph, d, sweep.position().gene, here);
      EXPECT_EQ(sweep.position().slot, here.gene.slot);
      EXPECT_EQ(sweep.above(), here.above.counts());
    }
    EXPECT_EQ(visited, 1 + d.genes[g].genes_below);
  }
}

TEST(Position, VisitsChildrenInSlotOrder) {
  const GeneratorGraph graph = guarded_tree();
  RandomStream random = stream(3);
  Derivation d = sample(graph, random).derivation;
  while (d.size() < 50) ASSERT_TRUE(grow(graph, d, {}, random));
  for (std::uint32_t g = 0; g < d.size(); ++g) {
    const GenePosition place = place_of(graph, d, g);
    std::vector<std::uint32_t> children;
    for_each_child(graph, d, place, [&](std::uint32_t slot, const GenePosition& child) {
      EXPECT_EQ(d.slots[place.slot + slot], SlotState::filled);
      EXPECT_EQ(child_in_slot(graph, d, place, slot).slot, child.slot);
      EXPECT_EQ(rule_of(graph, d.genes[g]).slots[slot].edge, d.genes[child.gene].edge);
      children.push_back(child.gene);
    });
    std::uint32_t below = 0;
    for (const std::uint32_t child : children) below += 1 + d.genes[child].genes_below;
    EXPECT_EQ(below, d.genes[g].genes_below);
  }
}

}  // namespace
}  // namespace espalier
