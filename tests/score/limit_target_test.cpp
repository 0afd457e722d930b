#include "score/limit_target.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "score/combined_objective.h"
#include "score/score_models.h"
#include "score/smootherstep.h"

namespace espalier {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Derivation genes(std::size_t n) {
  Derivation derivation;
  derivation.genes.resize(n);
  return derivation;
}

Limits one(Measure measure, const Limit& limit) {
  Limits limits;
  limits[measure] = limit;
  return limits;
}

/// A box of 1 x `height` x 1.
Model tower(float height) {
  Model model;
  model.instances = {part(kBox, box_frame(Vec3(0), Vec3(1, height, 1)))};
  return model;
}

double score_of(const LimitTarget& target, const Derivation& derivation, const Model& model) {
  return target.score(derivation, model, target.make_scratch().get());
}

Explanation explain(const LimitTarget& target, const Derivation& derivation, const Model& model) {
  return target.explain(derivation, model, target.make_scratch().get());
}

TEST(Limit, RampsUpAndDown) {
  const Limit up = {.from = 40, .to = 100, .weight = 0.2};
  EXPECT_EQ(up.cost(0), 0);
  EXPECT_EQ(up.cost(40), 0);
  EXPECT_EQ(up.cost(70), 0.1);
  EXPECT_EQ(up.cost(55), 0.2 * smootherstep(55, 40, 100));
  EXPECT_EQ(up.cost(100), 0.2);
  EXPECT_EQ(up.cost(1e300), 0.2);
  const Limit down = {.from = 0.5, .to = 0.25, .weight = 2};
  EXPECT_EQ(down.cost(0), 2);
  EXPECT_EQ(down.cost(0.25), 2);
  EXPECT_EQ(down.cost(0.375), 1);
  EXPECT_EQ(down.cost(0.5), 0);
  EXPECT_EQ(down.cost(1), 0);
  EXPECT_LT(down.cost(0.45), down.cost(0.44));
  EXPECT_EQ(Limit{}.cost(5), 0);
}

TEST(Limit, BoundsAllowTheirEnds) {
  const Limit limit = {.min = 4, .max = 300};
  EXPECT_TRUE(limit.accepts(4));
  EXPECT_TRUE(limit.accepts(300));
  EXPECT_FALSE(limit.accepts(300.0001));
  EXPECT_FALSE(limit.accepts(3));
  EXPECT_TRUE(Limit{}.accepts(-1e300));
}

TEST(Limit, SaysItInWords) {
  const Limit height = {.min = 0.5, .max = 6, .from = 4, .to = 6, .weight = 1};
  EXPECT_EQ(describe(Measure::height, height, 3), "height 3 m");
  EXPECT_EQ(describe(Measure::height, height, 5), "height 5 m: 1 m over 4 m, costs 0.5");
  EXPECT_EQ(describe_rejection(Measure::height, height, 7.1), "height 7.1 m is above max 6 m");
  EXPECT_EQ(describe_rejection(Measure::height, height, 0.25), "height 0.25 m is below min 0.5 m");
  EXPECT_EQ(describe_rejection(Measure::height, height, 6.000001), "height 6.000001 m is above max 6 m");
  EXPECT_EQ(describe_rejection(Measure::height, height, 6), "");
  EXPECT_EQ(describe_rejection(Measure::genes, {.min = 2}, 1), "1 gene is below min 2 genes");
  EXPECT_EQ(describe_rejection(Measure::depth, {.max = 2}, 3), "depth 3 levels is above max 2 levels");
  EXPECT_EQ(describe_rejection(Measure::parts, {.max = 2}, 3), "3 parts are above max 2 parts");
  EXPECT_EQ(describe(Measure::balance, {.from = 0.5, .to = 0, .weight = 1}, 0.25),
            "balance 0.25: 0.25 under 0.5, costs 0.5");
  EXPECT_EQ(describe_bounds(Measure::height, height), "0.5 to 6 m");
  EXPECT_EQ(describe_bounds(Measure::genes, {.max = 1}), "at most 1 gene");
  EXPECT_EQ(describe_bounds(Measure::balance, {.min = 0.3}), "at least 0.3");
  EXPECT_EQ(describe_bounds(Measure::balance, {}), "");
}

TEST(Limit, LengthTermsOfThePapers) {
  EXPECT_EQ(length_term("length-2016", 4, 300), (Limit{.from = 40, .to = 100, .weight = 0.2}));
  EXPECT_EQ(length_term("length-2017", 4, 300), (Limit{.from = 4, .to = 300, .weight = 0.1}));
  EXPECT_THROW(length_term("length-2018", 4, 300), Error);
}

TEST(LimitTarget, RefusesNonsense) {
  const auto error_of = [](const Limit& limit) -> std::string {
    try {
      LimitTarget(one(Measure::height, limit), MeshTable(), VolumeView::full);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of({.min = 5, .max = 4}), "limits.height: min must not be above max, got 5 and 4");
  EXPECT_EQ(error_of({.max = kInfinity}), "limits.height: min and max must be finite, got inf");
  EXPECT_EQ(error_of({.from = 5, .to = 5, .weight = 1}),
            "limits.height: from and to must differ where weight > 0, got 5 twice");
  EXPECT_EQ(error_of({.weight = -1}), "limits.height: weight must be finite and >= 0, got -1");
  EXPECT_EQ(error_of({.from = -kInfinity}), "limits.height: from and to must be finite, got -inf and 0");
  EXPECT_EQ(error_of({.min = 5, .max = 5}), "no error");
}

TEST(LimitTarget, SubtractsWhatTheRampsCost) {
  Limits limits = one(Measure::genes, {.from = 40, .to = 100, .weight = 0.25});
  limits[Measure::height] = {.from = 2, .to = 4, .weight = 3};
  const LimitTarget target(limits, test_meshes(), VolumeView::parts);
  EXPECT_EQ(score_of(target, genes(70), tower(1)), -0.125);
  EXPECT_EQ(score_of(target, genes(70), tower(3)), -0.125 - 1.5);
  const Explanation e = explain(target, genes(70), tower(3));
  EXPECT_EQ(e.name, "limits");
  EXPECT_EQ(e.score, -1.625);
  EXPECT_EQ(e.optimum, 0);
  EXPECT_EQ(e.rejected, "");
  EXPECT_EQ(e.words, "70 genes: 30 genes over 40 genes, costs 0.125, height 3 m: 1 m over 2 m, costs 1.5");
  ASSERT_EQ(e.terms.size(), 2u);
  EXPECT_EQ(e.terms[1].name, "height");
  EXPECT_EQ(e.terms[1].count, 3);
  EXPECT_EQ(e.terms[1].of, 4);
  EXPECT_EQ(e.terms[1].unit, "m");
  EXPECT_EQ(e.terms[0].value + e.terms[1].value, e.score);
}

TEST(LimitTarget, RejectsBeyondBoundsAndRemembersWhat) {
  Limits limits = one(Measure::genes, {.min = 2, .max = 10});
  limits[Measure::height] = {.max = 3, .from = 1, .to = 3, .weight = 1};
  limits[Measure::balance] = {.from = 0.5, .to = 0, .weight = 1};
  const LimitTarget target(limits, test_meshes(), VolumeView::full);
  EXPECT_TRUE(target.may_reject());
  const auto scratch = target.make_scratch();
  EXPECT_EQ(target.score(genes(5), tower(1), scratch.get()), 0);
  EXPECT_EQ(target.score(genes(5), tower(4), scratch.get()), -kInfinity);
  EXPECT_EQ(target.score(genes(1), tower(8), scratch.get()), -kInfinity);
  EXPECT_EQ(target.score(genes(11), tower(3), scratch.get()), -kInfinity);
  EXPECT_EQ(explain(target, genes(1), tower(8)).rejected, "1 gene is below min 2 genes, height 8 m is above max 3 m");
  const std::vector<Rejections> rejections = target.rejections(scratch.get());
  ASSERT_EQ(rejections.size(), 2u);  // balance has no bounds
  EXPECT_EQ(rejections[0].name, "genes");
  EXPECT_EQ(rejections[0].count, 2u);
  EXPECT_EQ(rejections[0].lowest, 1);
  EXPECT_EQ(rejections[0].highest, 11);
  EXPECT_EQ(rejections[1].bound, "at most 3 m");
  EXPECT_EQ(rejections[1].count, 2u);
  EXPECT_EQ(rejections[1].lowest, 4);
  EXPECT_EQ(rejections[1].highest, 8);
}

TEST(LimitTarget, RejectsUnfinishedModelsOnlyForWhatGrowthCannotMend) {
  Limits limits;
  limits[Measure::genes] = {.min = 5, .max = 8};
  limits[Measure::height] = {.min = 2, .max = 4};
  const LimitTarget target(limits, test_meshes(), VolumeView::full);
  const auto score = [&](std::size_t n, float height, SlotState last) {
    Derivation derivation = genes(n);
    derivation.slots = {SlotState::empty, last};
    return score_of(target, derivation, tower(height));
  };
  EXPECT_EQ(score(3, 3, SlotState::empty), -kInfinity);
  EXPECT_EQ(score(3, 3, SlotState::open), 0);
  EXPECT_EQ(score(6, 1, SlotState::empty), -kInfinity);
  EXPECT_EQ(score(6, 1, SlotState::open), 0);
  EXPECT_EQ(score(6, 5, SlotState::open), 0) << "an open slot may show what goes when it is decided";
  EXPECT_EQ(score(9, 3, SlotState::open), -kInfinity);
  EXPECT_EQ(score(6, 3, SlotState::filled), 0);
}

TEST(LimitTarget, AsksForAsMuchModelAsItsLimitsNeed) {
  const auto view_of = [](Measure measure, VolumeView view) {
    return LimitTarget(one(measure, {.max = 1}), test_meshes(), view).view();
  };
  for (const Measure measure : {Measure::genes, Measure::depth, Measure::balance}) {
    EXPECT_EQ(view_of(measure, VolumeView::full), TargetView::genes);
  }
  for (const Measure measure :
       {Measure::parts, Measure::triangles, Measure::height, Measure::spread, Measure::volume}) {
    EXPECT_EQ(view_of(measure, VolumeView::parts), TargetView::parts);
    EXPECT_EQ(view_of(measure, VolumeView::full), TargetView::full);
  }
}

TEST(LimitTarget, WarnsOfMeshFilesWithoutVolume) {
  class OpenFile final : public MeshSource {
   public:
    Mesh load(const std::string&) override {
      Mesh mesh = box_mesh(Vec3(0), Vec3(1));
      mesh.triangles.pop_back();
      return mesh;
    }
  };
  GeneratorGraph graph;
  graph.meshes.resize(1);
  graph.meshes[0].kind = MeshKind::file;
  graph.meshes[0].path = "leaky.obj";
  OpenFile source;
  const MeshTable meshes(graph, "", source);
  const LimitTarget volume(one(Measure::volume, {.max = 1}), meshes, VolumeView::full);
  EXPECT_THAT(volume.warnings(), ::testing::ElementsAre(HasSubstr("leaky.obj: is not closed")));
  EXPECT_TRUE(LimitTarget(one(Measure::height, {.max = 1}), meshes, VolumeView::full).warnings().empty());
}

/// Counts how often it is asked.
class Costly final : public Target {
 public:
  const std::string& name() const override { return name_; }
  TargetView view() const override { return TargetView::genes; }
  double score(const Derivation&, const Model&, TargetScratch*) const override { return ++asked, 7; }
  double optimum() const override { return 10; }
  Explanation explain(const Derivation&, const Model&, TargetScratch*) const override {
    Explanation e;
    e.score = 7, e.words = "seven";
    return e;
  }
  mutable int asked = 0;

 private:
  std::string name_ = "costly";
};

TEST(Objective, ARejectionIsTheScoreWhateverItsWeightAndSparesTheRest) {
  Objective objective;
  auto costly = std::make_unique<Costly>();
  const Costly& counter = *costly;
  objective.add(std::move(costly), 2);
  objective.add(std::make_unique<LimitTarget>(one(Measure::genes, {.max = 3}), MeshTable(), VolumeView::full), 0);
  Objective::Scratch scratch(objective);
  EXPECT_EQ(objective.score(genes(3), Model(), scratch), 14);
  EXPECT_EQ(counter.asked, 1);
  EXPECT_EQ(objective.score(genes(4), Model(), scratch), -kInfinity);
  EXPECT_EQ(counter.asked, 1);
  EXPECT_EQ(objective.rejections(scratch)[0].count, 1u);

  const Explanation e = objective.explain(genes(4), Model(), scratch);
  EXPECT_EQ(e.score, -kInfinity);
  EXPECT_EQ(e.rejected, "4 genes are above max 3 genes");
  EXPECT_EQ(e.words, "seven; 4 genes");
  EXPECT_FALSE(e.percent);
  EXPECT_EQ(objective.rejections(scratch)[0].count, 1u);  // explaining counts nothing
  EXPECT_EQ(objective.explain(genes(3), Model(), scratch).percent, 70);
}

}  // namespace
}  // namespace espalier
