#include "score/expected_direction.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "compiled.h"
#include "derivation/sample.h"
#include "model/expand.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

using namespace test;

RuleId rule_named(const GeneratorGraph& graph, const std::string& name) {
  for (RuleId rule = 0; rule < graph.rules.size(); ++rule) {
    if (graph.rules[rule].name == name) return rule;
  }
  ADD_FAILURE() << name;
  return 0;
}

Vec3 expected_of(const GeneratorGraph& graph, const std::string& name, const ExpectationSettings& settings = {}) {
  return expected_directions(graph, 5, settings)[rule_named(graph, name)];
}

TEST(ExpectedDirections, AreThoseOfTheBonesWhereNothingIsDrawn) {
  const auto graph = compiled(R"(grammar straight 1
start Root
rule Root { turn z 90deg  scale 3  move (7, 8, 9)  spawn Stem  move x 1  spawn Bare }
rule Stem { bone (1, 1, 1) -> (1, 3, 1)  move y 2  spawn Side }
rule Side { turn z -90deg  bone (0, 0, 0) -> (0, 4, 0) }
rule Bare { move y 1  emit box  spawn Barer }
rule Barer { emit sphere }
)");
  ASSERT_TRUE(graph);
  // At the origin, in a frame of its own: where the rule stood makes no difference.
  const Vec3 side = expected_of(*graph, "Side");
  EXPECT_NEAR(side.x, 4, 1e-6);
  EXPECT_NEAR(side.y, 0, 1e-6);
  EXPECT_EQ(side.z, 0);
  const Vec3 stem = expected_of(*graph, "Stem");
  EXPECT_NEAR(stem.x, 2, 1e-6);
  EXPECT_NEAR(stem.y, 1, 1e-6);
  EXPECT_NEAR(stem.z, 0, 1e-6);
  EXPECT_EQ(expected_of(*graph, "Bare"), Vec3(0));
  EXPECT_EQ(expected_of(*graph, "Barer"), Vec3(0));
}

// Over the bones of each model first: one of many bones counts no more than one of a single bone.
TEST(ExpectedDirections, AverageOverModelsNotOverBones) {
  const auto graph = compiled(R"(grammar uneven 1
start Root
rule Root { spawn Stem }
rule Stem {
  choose {
    1: { bone (0, 0, 0) -> (1, 0, 0) }
    1: { around y 3 { bone (0, 0, 0) -> (0, 1, 0) } }
    2: { }
  }
}
)");
  ASSERT_TRUE(graph);
  const Vec3 stem = expected_of(*graph, "Stem", {.samples = 8000});
  // Within five standard deviations of 1/4, the quarter of models; over bones it would be 1/16 and 3/16 or so.
  const double bound = 5 * std::sqrt(0.25 * 0.75 / 8000);
  EXPECT_NEAR(stem.x, 0.25, bound);
  EXPECT_NEAR(stem.y, 0.25, bound);
  EXPECT_EQ(stem.z, 0);
}

TEST(ExpectedDirections, ArgumentsAndSizesAreThoseThatWereMet) {
  const auto graph = compiled(R"(grammar met 1
start Root
rule Root { long ~ uniform(1.9, 2.1)  size (1, 5, 1)  for k in 1..3 { spawn Twig(k) } }
rule Twig(k) { bone (0, 0, 0) -> (k, scope.y, long) }
)");
  ASSERT_TRUE(graph);
  // Each of the three is met as often.
  const Vec3 twig = expected_of(*graph, "Twig", {.samples = 300});
  EXPECT_NEAR(twig.x, 2, 1e-5);
  EXPECT_NEAR(twig.y, 5, 1e-5);
  EXPECT_NEAR(twig.z, 2, 0.05);
}

TEST(ExpectedDirections, AreZeroWhereARuleIsNeverMet) {
  const auto graph = compiled(R"(grammar unmet 1
start Root
rule Root { maybe 0.9 spawn Twig  maybe 0.9 spawn Never }
rule Twig { bone (0, 0, 0) -> (0, 1, 0) }
rule Never when depth < 1 { bone (0, 0, 0) -> (0, 1, 0) }
)");
  ASSERT_TRUE(graph);
  EXPECT_EQ(expected_of(*graph, "Never"), Vec3(0));
  EXPECT_EQ(expected_of(*graph, "Root"), Vec3(0));  // the start gene stands in no slot
  EXPECT_EQ(expected_of(*graph, "Twig"), Vec3(0, 1, 0));
}

TEST(ExpectedDirections, AreAFunctionOfGraphAndSeed) {
  for (const std::string& name : shipped_grammars()) {
    const auto graph = compile_shipped(name);
    const auto once = expected_directions(*graph, 1), again = expected_directions(*graph, 1);
    EXPECT_EQ(once, again) << name;
    EXPECT_EQ(once.size(), graph->rules.size());
    for (const Vec3& direction : once) EXPECT_TRUE(std::isfinite(direction.x + direction.y + direction.z));
  }
  const auto tree = compile_shipped("guided-tree.esp");
  EXPECT_NE(expected_directions(*tree, 1), expected_directions(*tree, 2));
  EXPECT_NE(expected_of(*tree, "Branch"), Vec3(0));
}

/// Begins with this rule. None reads depth, and none has arguments: so a rule is everywhere the same.
std::string wild_grammar(const std::string& first) {
  return "grammar wild 1\nstart Seed\nrule Seed { spawn " + first + R"( }
rule Trunk { lean ~ uniform(0deg, 60deg)  turn z lean  bone (0, 0, 0) -> (0, 1, 0)  move y 1  spawn Fork }
rule Fork { maybe 0.7 spawn Branch  maybe 0.4 spawn Branch  maybe 0.3 spawn Leaf }
rule Branch {
  a ~ uniform(-20deg, 80deg)
  long ~ uniform(0.5, 2)
  choose {
    2: { turn x a  bone (0, 0, 0) -> (0.3, long, 0)  move y long }
    1: { turn z a  mirror x { bone (0, 0, 0) -> (long, 0.2, 0.4) } }
  }
  maybe 0.8 spawn Fork
}
rule Leaf { emit sphere }
)";
}

// Equation 9 by plain Monte Carlo: whole models that begin with the rule, grown slot by slot and expanded.
TEST(ExpectedDirections, AgreeWithPlainMonteCarlo) {
  const auto graph = compiled(wild_grammar("Trunk"));
  ASSERT_TRUE(graph);
  constexpr std::uint32_t kSamples = 4000;
  const ExpectationSettings settings{.samples = kSamples, .steps = 6};
  for (const std::string rule : {"Trunk", "Fork", "Branch"}) {
    SCOPED_TRACE(rule);
    const auto from_rule = compiled(wild_grammar(rule));
    ASSERT_TRUE(from_rule);
    Expander expander(*from_rule);
    Model model;
    DVec3 sum(0), squares(0);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      RandomStream random({9, Purpose::test, 0, i});
      Derivation d = seedling(*from_rule, random);
      // The rule's own bone takes a step.
      const std::uint32_t steps = settings.steps + (rule == "Fork" ? 0 : 1);
      for (std::uint32_t k = 0; k < steps; ++k) grow_open_slot(*from_rule, d, random);
      expander.expand(d, ExpandTo::bones, model);
      DVec3 mean(0);
      for (const Bone& bone : model.bones) mean += DVec3(bone.to) - DVec3(bone.from);
      if (!model.bones.empty()) mean /= static_cast<double>(model.bones.size());
      sum += mean, squares += mean * mean;
    }
    const DVec3 plain = sum / double{kSamples};
    const Vec3 expected = expected_of(*graph, rule, settings);
    for (int axis = 0; axis < 3; ++axis) {
      const double variance = squares[axis] / kSamples - plain[axis] * plain[axis];
      EXPECT_NEAR(expected[axis], plain[axis], 4.5 * std::sqrt(2 * variance / kSamples) + 1e-6) << axis;
    }
    EXPECT_GT(glm::length(plain), 0.1);
  }
  EXPECT_EQ(expected_of(*graph, "Leaf", {.samples = 50, .steps = 6}), Vec3(0));
}

// A chain without chance: as many links as steps, and the one that was met.
TEST(ExpectedDirections, ModelsGrowBySoManySteps) {
  const auto graph = compiled(R"(grammar chain 1
start Root
rule Root { spawn Link }
rule Link when depth < 40 { turn z 30deg  bone (0, 0, 0) -> (0, 1, 0)  move y 1  spawn Pause }
rule Pause { spawn Link }
)");
  ASSERT_TRUE(graph);
  for (const std::uint32_t steps : {1u, 2u, 10u}) {
    DVec3 mean(0);
    for (std::uint32_t k = 1; k <= steps + 1; ++k) {
      const double angle = k * 0.5235987755982988;
      mean += DVec3(-std::sin(angle), std::cos(angle), 0) / (steps + 1.0);
    }
    const ExpectationSettings settings{.samples = 3, .steps = steps};
    EXPECT_LT(glm::length(DVec3(expected_of(*graph, "Link", settings)) - mean), 1e-5) << steps;
  }
}

}  // namespace
}  // namespace espalier
