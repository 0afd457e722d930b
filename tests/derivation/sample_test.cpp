#include "derivation/sample.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "chi_square.h"
#include "derivation/encode.h"
#include "derivation/sweep.h"
#include "enumerate.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

/// Small, with a bit of everything: choices, guards by depth and by depth of a rule, weights and p by depth, required
/// slots that a guard ends.
GeneratorGraph tiny(std::optional<std::uint32_t> limit_b = {}) {
  GraphBuilder b("tiny");
  const RuleId root = b.rule("Root"), rule_a = b.rule("A"), rule_b = b.rule("B");
  b.guard(rule_a, depth_below(3));
  b.guard(rule_b, count_below(b.count(rule_b), 2));
  if (limit_b) b.limit(rule_b, *limit_b);
  b.maybe(root, rule_a, 0.4);
  b.spawn(root, rule_b);
  b.maybe(rule_a, rule_a, 0.5);
  b.maybe(rule_a, rule_b, by_depth(2, 0.3, 0.6));
  b.spawn(rule_b, rule_b);
  b.maybe(rule_b, rule_a, 0.25);
  b.variant(rule_a, by_depth(2, 1.0 / 3, 0), {}, {});
  b.variant(rule_a, by_depth(2, 2.0 / 3, 1), {}, {0, 1});
  b.variant(rule_b, 0.25, {}, {0});
  b.variant(rule_b, 0.75, {}, {1});
  return b.build();
}

std::map<std::string, double> prior_of(const GeneratorGraph& graph) {
  std::map<std::string, double> prior;
  double total = 0;
  const Enumeration enumeration(graph);
  for (const Enumerated& one : enumeration.all()) {
    bool within = true;
    for (const auto& [rule, n] : one.genes) within &= !graph.rules[rule].limit || n <= *graph.rules[rule].limit;
    if (!within) continue;
    prior[one.key] += one.probability;
    total += one.probability;
  }
  for (auto& [key, probability] : prior) probability /= total;
  return prior;
}

TEST(Prior, EnumeratedProbabilitiesSumToOne) {
  double sum = 0;
  const GeneratorGraph graph = tiny();
  const Enumeration enumeration(graph);
  for (const Enumerated& one : enumeration.all()) sum += one.probability;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_GT(enumeration.all().size(), 50u);
}

TEST(Sample, FollowsThePrior) {
  const GeneratorGraph graph = tiny();
  RandomStream random = stream(1);
  std::map<std::string, int> counts;
  for (int i = 0; i < 40000; ++i) ++counts[key_of(graph, sample(graph, random).derivation)];
  expect_distribution(prior_of(graph), counts);
}

TEST(Sample, IsConditionedOnLimits) {
  const GeneratorGraph graph = tiny(2);
  RandomStream random = stream(2);
  std::map<std::string, int> counts;
  for (int i = 0; i < 40000; ++i) ++counts[key_of(graph, sample(graph, random).derivation)];
  expect_distribution(prior_of(graph), counts);
}

TEST(Prior, LogPriorIsTheEnumeratedOne) {
  const GeneratorGraph graph = tiny();
  const std::map<std::string, double> prior = prior_of(graph);
  RandomStream random = stream(3);
  for (int i = 0; i < 2000; ++i) {
    const Derivation d = sample(graph, random).derivation;
    EXPECT_NEAR(log_prior(graph, d), std::log(prior.at(key_of(graph, d))), 1e-12);
  }
  // Limits do not renormalise.
  const GeneratorGraph limited = tiny(2);
  const Derivation d = sample(limited, random).derivation;
  EXPECT_EQ(log_prior(limited, d), log_prior(graph, d));
}

TEST(Prior, OpenSlotsAddNothing) {
  const GeneratorGraph graph = spaceship();
  RandomStream random = stream(4);
  EXPECT_EQ(log_prior(graph, seedling(graph, random)), 0);
}

TEST(Prior, IsMinusInfinityForWhatIsNeverMade) {
  GraphBuilder b("never");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.maybe(root, leaf, by_depth(5, 0, 0.5));
  const GeneratorGraph graph = b.build();
  const Derivation d{{{0, 0, 1, 0, 0}, {1, 0, 0, 0, 0}}, {SlotState::filled}, {}, 0};
  EXPECT_EQ(log_prior(graph, d), -std::numeric_limits<double>::infinity());
  EXPECT_NE(find_fault(graph, d), "");
}

TEST(Sample, IsValidAndAFunctionOfTheStream) {
  int sampled = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    RandomStream again = random;
    try {
      const SampleResult result = sample(graph, random, 50);
      EXPECT_EQ(find_fault(graph, result.derivation), "") << "seed " << seed;
      EXPECT_EQ(result.derivation, sample(graph, again, 50).derivation);
      EXPECT_LE(result.derivation.size(), 50u);
      EXPECT_TRUE(!result.truncated || result.derivation.size() == 50);
      ++sampled;
    } catch (const Error&) {  // the limits of a random graph may leave nothing
    }
  }
  EXPECT_GT(sampled, 1000);
}

TEST(Sample, StopsBreadthFirstAtItsBudget) {
  const GeneratorGraph graph = [] {
    GraphBuilder b("bush");
    const RuleId root = b.rule("Root", 1), twig = b.rule("Twig", 1);
    b.maybe(root, twig, 0.9, 3);
    b.maybe(twig, twig, 0.9, 3);
    return b.build();
  }();
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomStream random = stream(seed);
    const SampleResult result = sample(graph, random, 100);
    if (!result.truncated) continue;
    EXPECT_EQ(result.derivation.size(), 100u);
    // Slots are decided in layers: none at a depth below one that is still open.
    std::uint32_t first_open = 1000, last_decided = 0;
    GeneSweep sweep;
    sweep.begin(graph, result.derivation);
    while (sweep.next()) {
      for (std::size_t k = 0; k < sweep.variant().slots.size(); ++k) {
        const std::uint32_t depth = sweep.above().depth;
        if (sweep.slot(k) == SlotState::open) first_open = std::min(first_open, depth);
        else last_decided = std::max(last_decided, depth);
      }
    }
    EXPECT_LE(last_decided, first_open);
  }
}

TEST(Sample, NamesTheRuleWhoseLimitLeavesNothing) {
  GraphBuilder b("full");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.spawn(root, leaf, 3);
  b.limit(leaf, 2);
  const GeneratorGraph graph = b.build();
  RandomStream random = stream(5);
  try {
    sample(graph, random);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "grammar full: rule Leaf: 1000 samples in a row broke `limit 2`");
  }
}

TEST(Sample, NamesTheRuleWithoutAnAlternative) {
  GraphBuilder b("none");
  const RuleId root = b.rule("Root"), leaf = b.rule("Leaf");
  b.spawn(root, leaf);
  b.variant(leaf, by_depth(1, 0.5, 0), {}, {});
  b.variant(leaf, by_depth(1, 0.5, 0), {}, {});
  const GeneratorGraph graph = b.build();
  RandomStream random = stream(6);
  try {
    sample(graph, random);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "grammar none: rule Leaf: every alternative of a choice weighs 0 at depth 1");
  }
}

TEST(Sample, DrawsAndDetailSeedAreUniform) {
  const GeneratorGraph graph = spaceship();
  RandomStream random = stream(7);
  std::vector<int> draws(16), seeds(16);
  for (int i = 0; i < 4000; ++i) {
    const Derivation d = sample(graph, random).derivation;
    ++seeds[d.detail_seed >> 60];
    for (const std::uint32_t u : d.draws) ++draws[u >> 28];
  }
  expect_distribution(std::vector<double>(16, 1 / 16.0), draws);
  expect_distribution(std::vector<double>(16, 1 / 16.0), seeds);
}

TEST(Seedling, IsOneGeneWithOpenSlots) {
  GraphBuilder b("seed");
  const RuleId root = b.rule("Root", 2), low = b.rule("Low"), deep = b.rule("Deep");
  b.guard(low, depth_below(1));
  b.maybe(root, low, 0.5);
  b.maybe(root, deep, 0.5);
  b.spawn(root, deep);
  const GeneratorGraph graph = b.build();
  RandomStream random = stream(8);
  const Derivation d = seedling(graph, random);
  EXPECT_EQ(d.size(), 1u);
  EXPECT_EQ(d.draws.size(), 2u);
  EXPECT_EQ(d.slots, (std::vector<SlotState>{SlotState::absent, SlotState::open, SlotState::open}));
  EXPECT_EQ(find_fault(graph, d), "");
}

}  // namespace
}  // namespace espalier
