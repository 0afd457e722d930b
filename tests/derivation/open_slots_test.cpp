#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"
#include "chi_square.h"
#include "derivation/encode.h"
#include "derivation/sample.h"
#include "enumerate.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

std::size_t count_open(const Derivation& d) {
  return static_cast<std::size_t>(std::count(d.slots.begin(), d.slots.end(), SlotState::open));
}

GeneratorGraph tiny() {
  GraphBuilder b("tiny");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig"), leaf = b.rule("Leaf");
  b.guard(twig, depth_below(3));
  b.maybe(root, twig, 0.6, 2);
  b.maybe(twig, twig, 0.3);
  b.spawn(twig, leaf);
  b.variant(leaf, 0.5, {}, {});
  b.variant(leaf, 0.5, {}, {});
  return b.build();
}

TEST(GrowOpenSlot, StepByStepFollowsThePrior) {
  const GeneratorGraph graph = tiny();
  std::map<std::string, double> prior;
  const Enumeration enumeration(graph);
  for (const Enumerated& one : enumeration.all()) prior[one.key] += one.probability;
  RandomStream random = stream(1);
  std::map<std::string, int> counts;
  for (int i = 0; i < 20000; ++i) {
    Derivation d = seedling(graph, random);
    while (grow_open_slot(graph, d, random) == GrowthStep::grown) {
    }
    EXPECT_EQ(count_open(d), 0u);
    ++counts[key_of(graph, d)];
  }
  expect_distribution(prior, counts);
}

// Strict growth of a grammar with a limit, whatever the order: what is not stuck follows the prior, given that.
TEST(GrowOpenSlot, StrictGrowthRejectsLikeThePrior) {
  GraphBuilder b("limited");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig"), leaf = b.rule("Leaf");
  b.maybe(root, twig, 0.6, 2);
  b.maybe(twig, leaf, 0.5, 2);
  b.limit(leaf, 2);
  const GeneratorGraph graph = b.build();
  std::map<std::string, double> prior;
  double total = 0;
  const Enumeration enumeration(graph);
  for (const Enumerated& one : enumeration.all()) {
    const auto leaves = one.genes.find(leaf);
    if (leaves != one.genes.end() && leaves->second > 2) continue;
    total += one.probability;
    prior[one.key] += one.probability;
  }
  ASSERT_LT(total, 0.99);
  for (auto& [key, probability] : prior) probability /= total;
  for (const SlotOrder order : {SlotOrder::random, SlotOrder::depth_first}) {
    RandomStream random = stream(7);
    std::map<std::string, int> counts;
    int stuck = 0;
    constexpr int kTries = 20000;
    for (int i = 0; i < kTries; ++i) {
      Derivation d = seedling(graph, random);
      GrowthStep step = GrowthStep::grown;
      while (step == GrowthStep::grown) step = grow_open_slot(graph, d, random, order, true);
      if (step == GrowthStep::finished) ++counts[key_of(graph, d)];
      stuck += step == GrowthStep::stuck;
    }
    expect_distribution(prior, counts);
    EXPECT_NEAR(stuck, kTries * (1 - total), 4 * std::sqrt(kTries * total * (1 - total)));
  }
}

// Depth-first growth without chance: the genes come in the order that derivations store them.
TEST(GrowOpenSlot, DepthFirstGrowsInTheOrderOfTheText) {
  GeneratorGraph graph = tiny();
  Op bone;
  bone.code = OpCode::bone;
  for (Rule& rule : graph.rules) {
    for (Variant& variant : rule.variants) variant.program.ops.push_back(bone);
  }
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomStream random = stream(seed);
    Derivation d = seedling(graph, random);
    while (true) {
      const Derivation before = d;
      if (grow_open_slot(graph, d, random, SlotOrder::depth_first) != GrowthStep::grown) break;
      ASSERT_LE(d.size(), before.size() + 1);
      for (std::size_t g = 0; g < before.size(); ++g) ASSERT_EQ(d.genes[g].edge, before.genes[g].edge);
      const auto open = std::find(d.slots.begin(), d.slots.end(), SlotState::open);
      ASSERT_TRUE(d.size() > before.size() || open == d.slots.end());
    }
    EXPECT_TRUE(is_finished(d));
  }
}

TEST(GrowOpenSlot, AStepEndsWithAGeneThatMakesSomething) {
  GeneratorGraph graph = tiny();
  Op emit;
  emit.code = OpCode::emit;
  for (Variant& variant : graph.rules[2].variants) variant.program.ops = {emit, Op{}};
  EXPECT_TRUE(makes_something(graph.rules[2].variants[0]));
  EXPECT_FALSE(makes_something(graph.rules[1].variants[0]));
  int steps = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomStream random = stream(seed);
    Derivation d = seedling(graph, random);
    const auto leaves = [&] {
      return std::count_if(d.genes.begin(), d.genes.end(), [](const GeneRecord& gene) { return gene.edge == 3; });
    };
    for (long before = 0; grow_open_slot(graph, d, random) == GrowthStep::grown; ++steps) {
      ASSERT_EQ(find_fault(graph, d), "");
      EXPECT_TRUE(leaves() == before + 1 || (leaves() == before && count_open(d) == 0));
      before = leaves();
    }
  }
  EXPECT_GT(steps, 500);
}

TEST(GrowOpenSlot, PicksOpenSlotsUniformly) {
  GraphBuilder b("star");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.spawn(root, leaf);
  b.maybe(root, leaf, 0.999, 3);
  GeneratorGraph graph = b.build();
  Op bone;
  bone.code = OpCode::bone;
  graph.rules[leaf].variants[0].program.ops.push_back(bone);
  std::vector<int> counts(4);
  RandomStream random = stream(3);
  for (int i = 0; i < 8000; ++i) {
    Derivation d = seedling(graph, random);
    ASSERT_EQ(grow_open_slot(graph, d, random), GrowthStep::grown);
    const auto filled = std::find(d.slots.begin(), d.slots.end(), SlotState::filled);
    if (count_open(d) == 3) ++counts[static_cast<std::size_t>(filled - d.slots.begin())];
  }
  expect_distribution(std::vector<double>(4, 0.25), counts);
}

TEST(GrowOpenSlot, StaysValidOnRandomGraphs) {
  int steps = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    RandomStream random = stream(seed + 100);
    GeneratorGraph graph = random_graph(random);
    for (Rule& rule : graph.rules) {
      if (random.chance(0.5)) continue;
      Op emit;
      emit.code = OpCode::emit;
      for (Variant& variant : rule.variants) variant.program.ops.push_back(emit);
    }
    std::optional<Derivation> d = random_derivation(graph, random, 5);
    for (int k = 0; d && k < 20 && d->size() < 500; ++k) {
      const Derivation before = *d;
      const bool grown = grow_open_slot(graph, *d, random) == GrowthStep::grown;
      ASSERT_EQ(find_fault(graph, *d), "") << "seed " << seed;
      EXPECT_EQ(grown, !(before == *d));
      EXPECT_EQ(d->detail_seed, before.detail_seed);
      steps += grown;
      if (!grown) break;
    }
  }
  EXPECT_GT(steps, 100);
}

TEST(GrowOpenSlot, LeavesRequiredSlotsOfAFullRuleOpen) {
  GraphBuilder b("full");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.spawn(root, leaf, 2);
  b.maybe(root, leaf, 0.999999);
  b.limit(leaf, 1);
  const GeneratorGraph graph = b.build();
  RandomStream random = stream(4);
  for (int i = 0; i < 50; ++i) {
    Derivation d = seedling(graph, random);
    while (grow_open_slot(graph, d, random) == GrowthStep::grown) {
    }
    EXPECT_EQ(find_fault(graph, d), "");
    EXPECT_EQ(d.size(), 2u);
    EXPECT_LE(count_open(d), 2u);
    const Derivation before = d;
    EXPECT_FALSE(close_open_slots(graph, d, random));
    EXPECT_EQ(d, before);
  }
}

TEST(CloseOpenSlots, EmptiesOptionalAndGrowsRequired) {
  GraphBuilder b("close");
  const RuleId root = b.rule("Root"), twig = b.rule("Twig", 1), leaf = b.rule("Leaf", 1);
  b.spawn(root, twig, 2);
  b.maybe(root, leaf, 0.9);
  b.spawn(twig, leaf);
  b.maybe(twig, twig, 0.9);
  const GeneratorGraph graph = b.build();
  RandomStream random = stream(5);
  Derivation d = seedling(graph, random);
  ASSERT_TRUE(close_open_slots(graph, d, random));
  EXPECT_EQ(key_of(graph, d), "0.0FFE 1.0FE 3.0 1.0FE 3.0 ");
  EXPECT_EQ(find_fault(graph, d), "");
  const Derivation closed = d;
  EXPECT_TRUE(close_open_slots(graph, d, random));
  EXPECT_EQ(d, closed);
}

TEST(CloseOpenSlots, KeepsWhatWasDecided) {
  int closed_some = 0;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    RandomStream random = stream(seed + 5000);
    const GeneratorGraph graph = random_graph(random);
    Derivation before;
    try {
      before = sample(graph, random, 1 + random.below(12)).derivation;
    } catch (const Error&) {
      continue;
    }
    Derivation d = before;
    if (!close_open_slots(graph, d, random)) {
      EXPECT_EQ(d, before);
      continue;
    }
    EXPECT_EQ(count_open(d), 0u);
    ASSERT_EQ(find_fault(graph, d), "");
    closed_some += !(d == before);
    for (std::uint32_t g = 0; g < before.size(); ++g) {
      const std::optional<std::uint32_t> now = find_gene(graph, d, gene_path(graph, before, g));
      ASSERT_TRUE(now.has_value());
      EXPECT_EQ(d.genes[*now].variant, before.genes[g].variant);
      const GenePosition was = place_of(graph, before, g), is = place_of(graph, d, *now);
      const Variant& variant = variant_of(graph, before.genes[g]);
      EXPECT_TRUE(equal_run(before.draws, was.draw, d.draws, is.draw, variant.draws.size()));
      for (std::size_t k = 0; k < variant.slots.size(); ++k) {
        const SlotState old_state = before.slots[was.slot + k];
        EXPECT_TRUE(old_state == SlotState::open || old_state == d.slots[is.slot + k]);
      }
    }
  }
  EXPECT_GT(closed_some, 150);
}

}  // namespace
}  // namespace espalier
