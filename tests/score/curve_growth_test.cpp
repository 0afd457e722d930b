#include "score/curve_growth.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "compiled.h"
#include "derivation/encode.h"
#include "model/expand.h"
#include "score/curve_target.h"
#include "score/random_curves.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

using namespace test;

/// Bones under mirrors, around an axis and in the start rule; a rule without bones; a required slot.
std::shared_ptr<const GeneratorGraph> bushy() {
  return compiled(R"(grammar bushy 1
start Root
rule Root {
  lean ~ uniform(-40deg, 40deg)
  bone (0, 0, 0) -> (0, 0.2, 0)
  mirror x { move (0.2, 0.2, 0)  turn z lean  spawn Twig(0.3) }
  around y 3 { move z 0.3  maybe 0.8 spawn Twig(0.2) }
  move y 0.2  spawn Fork
}
rule Fork { maybe 0.8 spawn Twig(0.25)  maybe 0.8 spawn Twig(0.25)  maybe 0.3 spawn Fork }
rule Twig(long) when depth < 9 {
  a ~ uniform(-50deg, 50deg)
  b ~ angle()
  turn y b  turn z a
  bone (0, 0, 0) -> (0, long, 0)
  move y long
  mirror z { move z 0.05  maybe 0.3 spawn Twig(long * 0.9) }
  maybe 0.8 spawn Fork
}
)");
}

/// As the guided engine does it: derivations that grow at places, with all else that may happen to them.
class Places {
 public:
  Places(const GeneratorGraph& graph, const CurveSettings& settings, double weight, std::uint32_t index)
      : graph_(graph),
        target_(settings),
        weight_(weight),
        random_(curve_stream(index)),
        pool_(graph),
        expander_(graph),
        frames_(graph) {
    for (RuleId rule = 0; rule < graph.rules.size(); ++rule) {
      expected_.push_back(rule % 3 == 2 ? Vec3(0) : random_place(random_, 1));
    }
    growth_ = std::make_unique<CurveGrowth>(graph, target_.cost(), weight, expected_);
  }

  std::size_t size() const { return trees_.size(); }
  GrowthPool& pool() { return pool_; }
  CurveGrowth& growth() { return *growth_; }
  const std::vector<GrowingDerivation>& trees() const { return trees_; }
  const std::vector<Vec3>& expected() const { return expected_; }
  const GeneExpander& frames() const { return frames_; }
  RandomStream& random() { return random_; }

  void begin(std::size_t places) {
    pool_.clear();
    frames_.clear();
    growth_->begin(places);
    trees_.clear();
    for (std::size_t k = 0; k < places; ++k) {
      trees_.push_back(pool_.begin(random_));
      grown(k, trees_[k].last);
    }
  }
  void grow(std::uint32_t most_genes) {
    for (std::size_t k = 0; k < trees_.size(); ++k) {
      pool_.grow(trees_[k], random_, most_genes, [&](ShootId shoot) { grown(k, shoot); });
    }
  }
  /// Resampling, to another number of places.
  void follow() {
    std::vector<std::uint32_t> ancestors;
    std::vector<GrowingDerivation> followers;
    for (std::uint32_t n = 2 + random_.below(6); n > 0; --n) {
      ancestors.push_back(random_.below(static_cast<std::uint32_t>(trees_.size())));
      followers.push_back(trees_[ancestors.back()]);
    }
    trees_ = followers;
    growth_->follow(ancestors);
  }
  void cut_back(std::size_t place) {
    std::vector<ShootId> history;
    std::vector<std::uint32_t> parents, kept;
    pool_.history(trees_[place], history);
    pool_.parents(history, parents);
    std::vector<std::uint8_t> cut(history.size());
    for (std::uint8_t& c : cut) c = random_.chance(0.2);
    const auto first = static_cast<ShootId>(pool_.shoots());
    trees_[place] = pool_.cut_back(trees_[place], history, parents, cut, kept);
    growth_->clear(place);
    for (std::uint32_t k = 0; k < kept.size(); ++k) {
      if (pool_.shoot(first + k).filled) growth_->grown_again(place, first + k, history[kept[k]]);
    }
  }
  void renumber() {
    std::vector<GrowingDerivation*> living;
    for (GrowingDerivation& tree : trees_) living.push_back(&tree);
    GrowthRenumbering renumbering;
    pool_.keep_only(living, renumbering);
    growth_->renumber(renumbering);
    frames_.renumber(renumbering);
  }

  std::vector<double> scores() {
    std::vector<double> scores(trees_.size());
    growth_->score(pool_, trees_, scores);
    return scores;
  }
  std::vector<double> promises() {
    std::vector<double> promises(trees_.size());
    growth_->promise(pool_, trees_, promises);
    return promises;
  }
  /// What the target says of the model.
  double packed_score(std::size_t place) {
    const Derivation packed = pool_.pack(trees_[place]);
    EXPECT_EQ(find_fault(graph_, packed), "");
    expander_.expand(packed, ExpandTo::bones, model_);
    return weight_ * target_.score(packed, model_, target_.make_scratch().get());
  }

  /// Scores are the target's bit for bit, promises those of equation 10.
  void check() {
    const std::vector<double> scores = this->scores(), promises = this->promises();
    for (std::size_t k = 0; k < trees_.size(); ++k) {
      ASSERT_EQ(scores[k], packed_score(k));
      std::int64_t promise = 0;
      Frame frame;
      for (const BudId bud : trees_[k].open) {
        const Vec3& expected = expected_[graph_.edges[pool_.bud(bud).edge].child];
        if (expected == Vec3(0) || !frames_.frame(bud, frame)) continue;
        promise += target_.cost().alignment(target_.cost().nearest(frame.origin), frame.vector(expected));
      }
      ASSERT_EQ(promises[k], -weight_ * kCostUnit * static_cast<double>(promise));
    }
    EXPECT_EQ(this->promises(), promises);  // asked again, what is kept is the same
    ++checks;
    distinct += scores.size() > 1 && scores[0] != scores[1];
  }

  int checks = 0, distinct = 0;

 private:
  void grown(std::size_t place, ShootId shoot) {
    growth_->grown(place, pool_, shoot);
    frames_.run(pool_, shoot);
  }

  const GeneratorGraph& graph_;
  CurveTarget target_;
  double weight_;
  RandomStream random_;
  GrowthPool pool_;
  Expander expander_;
  GeneExpander frames_;
  Model model_;
  std::vector<Vec3> expected_;
  std::unique_ptr<CurveGrowth> growth_;
  std::vector<GrowingDerivation> trees_;
};

CurveSettings settings_number(std::uint32_t i) {
  RandomStream random = curve_stream(600 + i);
  CurveSettings settings = random_settings(random, 1 + i % 3);
  settings.blend = i % 2 == 1;
  if (i == 2) settings.field_cells = 9;
  if (i == 3) settings.density = BoneDensity{Vec3(-1), Vec3(1), 0.3, 4, 2};
  if (i == 4) settings.curves[0].thickness = {0.1, 0.4}, settings.curves[0].utilisation = 0;
  return settings;
}

void check_all_that_may_happen(const GeneratorGraph& graph, const CurveSettings& settings, double weight,
                               std::uint32_t index) {
  Places places(graph, settings, weight, index);
  for (int sweep = 0; sweep < 2 && !testing::Test::HasFatalFailure(); ++sweep) {
    places.begin(4);
    places.check();
    for (int step = 0; step < 16 && !testing::Test::HasFatalFailure(); ++step) {
      places.grow(150);
      places.check();
      if (step % 3 == 0) places.follow(), places.check();
      if (step % 4 == 1) places.cut_back(places.random().below(static_cast<std::uint32_t>(places.size()))), places.check();
      if (step % 5 == 3) places.renumber(), places.check();
    }
  }
  EXPECT_EQ(places.checks, 2 * (1 + 16 + 6 + 4 + 3));
  EXPECT_GT(places.distinct, places.checks / 4);
}

TEST(CurveGrowth, ScoresAndPromisesAsTheTargetAtEveryStep) {
  const auto graph = bushy();
  ASSERT_TRUE(graph);
  for (std::uint32_t i = 0; i < 5; ++i) {
    SCOPED_TRACE(i);
    check_all_that_may_happen(*graph, settings_number(i), i % 2 ? 0.3 : 1, i);
  }
}

TEST(CurveGrowth, ScoresShippedGrammarsAsTheTargetDoes) {
  for (const char* name : {"guided-tree.esp", "plant.esp", "tree-v1.esp", "cathedral.esp", "mondrian.esp", "snake.esp"}) {
    SCOPED_TRACE(name);
    const auto graph = compile_shipped(name);
    Places places(*graph, settings_number(1), 2.5, 50);
    places.begin(6);
    for (int step = 0; step < 12 && !HasFatalFailure(); ++step) {
      for (int k = 0; k < 3; ++k) places.grow(200);
      places.check();
      if (step % 2 == 0) places.follow();
      if (step % 3 == 1) places.cut_back(0);
      if (step % 4 == 2) places.renumber();
    }
    places.check();
  }
}

// The guided engine keeps the best beside particles that have left it behind: copies live on without their origin.
TEST(CurveGrowth, CopiesOfWhatIsForgottenStayWhatTheyAre) {
  const auto graph = bushy();
  for (std::uint32_t index = 70; index < 76; ++index) {
    Places places(*graph, settings_number(1), 1, index);
    places.begin(5);
    for (int k = 0; k < 4; ++k) places.grow(100);
    for (int round = 0; round < 4 && !HasFatalFailure(); ++round) {
      places.cut_back(1);
      places.cut_back(3);
      places.renumber();
      places.check();
      places.grow(150);
      places.check();
    }
  }
}

TEST(CurveGrowth, PromisesByEquationTen) {
  const auto graph = bushy();
  const CurveSettings settings = settings_number(0);
  const ReferenceCurves reference(settings);
  Places places(*graph, settings, 0.7, 80);
  int compared = 0;
  double greatest = 0;
  for (int sweep = 0; sweep < 6; ++sweep) {
    places.begin(4);
    for (int step = 0; step < 6; ++step) {
      places.grow(100);
      const std::vector<double> promises = places.promises();
      for (std::size_t k = 0; k < places.size(); ++k) {
        double cost = 0;
        bool steady = true;
        for (const BudId bud : places.trees()[k].open) {
          Frame frame;
          if (!places.frames().frame(bud, frame)) continue;
          const Vec3& expected = places.expected()[graph->edges[places.pool().bud(bud).edge].child];
          steady = steady && is_steady(reference, DVec3(frame.origin));
          cost += reference.alignment(reference.nearest(DVec3(frame.origin)), DVec3(frame.vector(expected)));
        }
        if (!steady) continue;
        ++compared;
        EXPECT_NEAR(promises[k], -0.7 * cost, 0.02 * static_cast<double>(1 + places.trees()[k].open.size()));
        greatest = std::max(greatest, std::abs(cost));
      }
    }
  }
  EXPECT_GT(compared, 50);
  EXPECT_GT(greatest, 100);
}

TEST(CurveGrowth, AGeneIsWorthWhatItAdded) {
  const auto graph = bushy();
  Places places(*graph, settings_number(3), 0.5, 90);
  places.begin(1);
  int looked = 0;
  for (int step = 0; step < 25; ++step) {
    const ShootId before = places.trees()[0].last;
    const double score = places.scores()[0];
    places.grow(150);
    double worth = 0;
    for (ShootId id = places.trees()[0].last; id != before; id = places.pool().shoot(id).previous) {
      if (places.pool().shoot(id).filled) worth += places.growth().worth(id);
    }
    EXPECT_NEAR(places.scores()[0] - score, worth, 1e-6);
    looked += worth != 0;
  }
  EXPECT_GT(looked, 10);
  // What is cut back and stands again is worth what it adds now: all together the score.
  places.cut_back(0);
  for (const bool renumbered : {false, true}) {
    if (renumbered) places.renumber();
    std::vector<ShootId> history;
    places.pool().history(places.trees()[0], history);
    double worth = 0;
    for (const ShootId id : history) {
      if (places.pool().shoot(id).filled) worth += places.growth().worth(id);
    }
    EXPECT_NEAR(places.scores()[0], worth, 1e-6);
  }
}

TEST(CurveGrowth, PlacesBeginEmpty) {
  const auto graph = bushy();
  Places places(*graph, settings_number(0), 1, 95);
  places.begin(3);
  for (int k = 0; k < 5; ++k) places.grow(100);
  EXPECT_NE(places.scores()[0], 0);
  places.growth().clear(1);
  EXPECT_EQ(places.scores()[1], 0);
  EXPECT_EQ(places.growth().tally(1).total(), 0);
  EXPECT_EQ(places.scores()[2], places.packed_score(2));
  places.begin(2);
  EXPECT_EQ(places.scores().size(), 2u);
  places.check();
}

}  // namespace
}  // namespace espalier
