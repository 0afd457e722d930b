#include "breed/viability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "breed/breed_fixture.h"
#include "breed/newcomer.h"
#include "model/expand.h"

namespace espalier {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A grammar of one rule that emits what `body` says.
ViabilityReport judged(const std::string& body, const ViabilitySettings& settings = ViabilitySettings()) {
  const CompileResult result = compile_grammar({"g.esp", "grammar g 1\nstart A\nrule A {\n" + body + "\n}\n", {}, {}});
  EXPECT_TRUE(result.graph) << render(result.diagnostics, result.sources);
  const MeshTable meshes = test::meshes_of(*result.graph);
  Expander expander(*result.graph);
  Model model;
  RandomStream random({1, Purpose::test, 0, 0, 0});
  const Derivation derivation = draw_newcomer(*result.graph, random);
  expander.expand(derivation, ExpandTo::full, model);
  Viability::Scratch scratch;
  return Viability(meshes, settings).judge(derivation, model, scratch);
}

TEST(Viability, AllowsWhatStandsOnTheGround) {
  const ViabilityReport report = judged("move y 0.5  emit box");
  EXPECT_TRUE(report.viable);
  EXPECT_EQ(report.below_ground, 0);
  EXPECT_NEAR(report.measures[Measure::height], 1, 1e-6);
}

TEST(Viability, MeasuresWhatIsBelowTheGround) {
  const ViabilityReport half = judged("emit box");
  EXPECT_NEAR(half.below_ground, 0.5, 1e-6);
  EXPECT_FALSE(half.viable);
  EXPECT_THAT(half.reasons, ElementsAre("50 % of it grows below the ground"));
  const ViabilityReport quarter = judged("move y 0.5  emit box  move y -1  move x 5  { move y 0.5  emit box }  emit box");
  EXPECT_NEAR(quarter.below_ground, 0.5, 1e-6);  // of three boxes: none, half, all
  ViabilitySettings any;
  any.most_below_ground = 1;
  EXPECT_TRUE(judged("move y -3  emit box", any).viable);
}

TEST(Viability, FindsPartsInsideEachOther) {
  EXPECT_NEAR(judged("for i in 0..3 { move x 1.01 * i  move y 0.5  emit box }").crowding, 0, 0.03);
  // Four boxes in one place, the space of one: three quarters find no room.
  const ViabilityReport crowded = judged("move y 0.5  for i in 0..3 { emit box }");
  EXPECT_NEAR(crowded.crowding, 0.75, 0.02);
  EXPECT_THAT(crowded.reasons, ElementsAre("75 % of it lies inside other parts"));
  EXPECT_EQ(judged("move y 0.5  emit box").crowding, 0);
  EXPECT_LT(judged("move y 0.5  emit sphere").crowding, 1e-6);
}

TEST(Viability, NothingToSeeIsNotViable) {
  const ViabilityReport report = judged("move y 1");
  EXPECT_THAT(report.reasons, ElementsAre("there is nothing to see"));
}

TEST(Viability, HardLimitsCountAndRampsDoNot) {
  ViabilitySettings settings;
  settings.limits[Measure::triangles].max = 11;
  EXPECT_THAT(judged("move y 0.5  emit box", settings).reasons, ElementsAre(HasSubstr("above max 11")));
  settings.limits[Measure::triangles] = {.from = 1, .to = 2, .weight = 5};
  EXPECT_TRUE(judged("move y 0.5  emit box", settings).viable);
}

TEST(Viability, RefusesBadSettings) {
  ViabilitySettings settings;
  settings.most_crowding = 2;
  EXPECT_THROW(judged("emit box", settings), Error);
}

TEST(UsualViability, KnowsWhichGrammarsStandOnTheGround) {
  const auto usual = [](const std::string& name) {
    const auto graph = test::compile_shipped(name);
    return usual_viability(*graph, test::meshes_of(*graph));
  };
  EXPECT_EQ(usual("gentree.esp").most_below_ground, ViabilitySettings().most_below_ground);
  EXPECT_EQ(usual("plant.esp").most_below_ground, ViabilitySettings().most_below_ground);
  EXPECT_EQ(usual("spaceship.esp").most_below_ground, 1);
}

}  // namespace
}  // namespace espalier
