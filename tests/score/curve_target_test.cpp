#include "score/curve_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "score/combined_objective.h"
#include "score/random_curves.h"

namespace espalier {
namespace {

using namespace test;
using ::testing::HasSubstr;

Model model_of(const std::vector<Bone>& bones) {
  Model model;
  model.bones = bones;
  return model;
}

std::vector<std::string> term_names(const Explanation& e) {
  std::vector<std::string> names;
  for (const Term& term : e.terms) names.push_back(term.name);
  return names;
}

TEST(CurveTarget, ScoreIsTheCostBelowZero) {
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    RandomStream random = curve_stream(300 + seed);
    const CurveSettings settings = random_settings(random, 2);
    const ReferenceCurves reference(settings);
    const std::vector<Bone> bones = random_skeleton(reference, random, 20);
    const CurveTarget target(settings);
    const auto scratch = target.make_scratch();
    const double score = target.score({}, model_of(bones), scratch.get());
    EXPECT_NEAR(score, -reference.costs(bones).total(), 0.4);
    EXPECT_NE(score, 0);
    // What was there before is forgotten.
    EXPECT_EQ(target.score({}, model_of({}), scratch.get()), 0);
    EXPECT_EQ(target.score({}, model_of(bones), scratch.get()), score);
  }
}

TEST(CurveTarget, LooksAtBonesAlone) {
  RandomStream random = curve_stream(310);
  const CurveTarget target(random_settings(random, 1));
  EXPECT_EQ(target.view(), TargetView::bones);
  EXPECT_EQ(target.name(), "curves");
  EXPECT_EQ(target.optimum(), 0);
  EXPECT_FALSE(target.may_reject());
  EXPECT_EQ(target.make_session(), nullptr);
}

TEST(CurveTarget, ExplainsItselfTermByTerm) {
  RandomStream random = curve_stream(311);
  CurveSettings settings = random_settings(random, 2);
  for (const bool dense : {false, true}) {
    if (dense) settings.density = BoneDensity{Vec3(-2), Vec3(2), 2, 0.25, 8};
    const ReferenceCurves reference(settings);
    const std::vector<Bone> bones = random_skeleton(reference, random, 20);
    const CurveTarget target(settings);
    const auto scratch = target.make_scratch();
    const Explanation e = target.explain({}, model_of(bones), scratch.get());
    EXPECT_EQ(e.name, "curves");
    EXPECT_EQ(e.score, target.score({}, model_of(bones), scratch.get()));
    EXPECT_FALSE(e.percent);
    std::vector<std::string> names = {"distance", "alignment", "utilisation"};
    if (dense) names.push_back("density");
    EXPECT_EQ(term_names(e), names);
    const ReferenceCosts costs = reference.costs(bones);
    const double wanted[] = {costs.distance, costs.alignment, costs.utilisation, costs.density};
    double sum = 0;
    for (std::size_t i = 0; i < e.terms.size(); ++i) {
      const Term& term = e.terms[i];
      EXPECT_NEAR(term.count, wanted[i], 0.1) << term.name;
      EXPECT_EQ(term.value, -term.count);
      EXPECT_EQ(term.weight, -1);
      EXPECT_EQ(term.unit, "cost");
      sum += term.value;
    }
    EXPECT_EQ(sum, e.score);
    EXPECT_EQ(costs.density > 0, dense);
  }
}

TEST(CurveTarget, SaysItInWords) {
  CurveSettings settings;
  settings.curves.resize(1);
  settings.curves[0].curve = {{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}};
  settings.curves[0].segment = 0.375;  // eight of them
  const CurveTarget target(settings);
  const auto words = [&](const std::vector<Bone>& bones) {
    return target.explain({}, model_of(bones), target.make_scratch().get()).words;
  };
  EXPECT_EQ(words({}), "0 bones, 0 % of the curves used");
  EXPECT_EQ(words({bone_between({0, 0, 0}, {0.5f, 0, 0}), bone_between({0, 0, 0}, {0.1f, 0, 0})}),
            "2 bones, 25 % of the curves used");
  EXPECT_EQ(words({bone_between({-1, 0, 0}, {9, 0, 0})}), "1 bone, 100 % of the curves used");
}

TEST(CurveTarget, CountsByItsWeightInAnObjective) {
  RandomStream random = curve_stream(312);
  const CurveSettings settings = random_settings(random, 2);
  const CurveTarget alone(settings);
  Objective objective;
  objective.add(std::make_unique<CurveTarget>(settings), 0.25);
  const Model model = model_of({bone_between({0, 0, 0}, {0, 1, 0})});
  Objective::Scratch scratch(objective);
  EXPECT_EQ(objective.view(), TargetView::bones);
  EXPECT_EQ(objective.score({}, model, scratch), 0.25 * alone.score({}, model, alone.make_scratch().get()));
  const Explanation e = objective.explain({}, model, scratch);
  double sum = 0;
  for (const Term& term : e.terms) sum += term.value;
  EXPECT_NEAR(sum, e.score, 1e-9);
}

TEST(CurveTarget, RefusesBadSettings) { EXPECT_THROW(CurveTarget{CurveSettings{}}, Error); }

}  // namespace
}  // namespace espalier
