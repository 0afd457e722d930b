// Sessions against the scoring of whole models, bit by bit: chains of random proposals, commits and rollbacks.
#include "score/volume_session.h"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "score/combined_objective.h"
#include "score/score_models.h"

namespace espalier {
namespace {

using namespace test;

constexpr float kFar = 1e7f;

/// Two targets that overlap, with weights that tell every count; the grid's cells are no multiples of tiles and blocks.
VolumeSettings settings_of(std::uint32_t number) {
  VolumeSettings s;
  s.grid = {Vec3(-1, -2, 0), Vec3(2, 2, 3), {number % 3 == 0 ? 290u : 37u, 51, 70}};
  constexpr VolumeForm kForms[] = {VolumeForm::linear, VolumeForm::smootherstep, VolumeForm::smootherstep_separate};
  s.form = kForms[number % 3];
  s.overlap_count = number / 3 % 2 == 0 ? OverlapCount::voxels : OverlapCount::hits;
  s.overlap_weight = 0.7291;
  s.outside_weight = -0.1237;
  s.view = number / 6 % 2 == 0 ? VolumeView::full : VolumeView::parts;
  s.meshes.push_back({"first", box_mesh(Vec3(-0.5f, -1, 0.5f), Vec3(1, 1, 2)), 1.0173, -0.5311});
  if (number % 2 == 0) s.meshes.push_back({"second", box_mesh(Vec3(0, 0, 0), Vec3(1.5f, 1.5f, 2.5f)), 0.3719, -0.2113});
  return s;
}

Instance random_part(Dice& dice, float size) {
  const Frame frame = random_frame(dice, Vec3(-1.5f, -2.5f, -0.5f), Vec3(2.5f, 2.5f, 3.5f), size);
  Instance made = part(static_cast<std::uint16_t>(dice.below(kShapes)), frame, dice.between(0, 1.5f));
  made.layer = static_cast<Layer>(dice.below(3));
  made.gene = dice.below(1000);
  if (dice.chance(0.02)) made.model_from_mesh.origin[1] = std::numeric_limits<float>::quiet_NaN();
  if (dice.chance(0.02)) made.model_from_mesh.basis = Mat3(kFar);
  return made;
}

std::vector<Instance> random_parts(Dice& dice, std::size_t count, float size) {
  std::vector<Instance> parts;
  for (std::size_t i = 0; i < count; ++i) parts.push_back(random_part(dice, size));
  return parts;
}

/// A slice gives way to other parts; sometimes to very many, sometimes nothing changes.
std::vector<Instance> propose(Dice& dice, const std::vector<Instance>& state, float size) {
  std::vector<Instance> next = state;
  const auto first = dice.below(static_cast<std::uint32_t>(state.size()) + 1);
  const auto longest = dice.chance(0.15) ? state.size() - first : std::min<std::size_t>(4, state.size() - first);
  const auto removed = dice.below(static_cast<std::uint32_t>(longest) + 1);
  const auto at = next.begin() + first;
  const auto rest = next.erase(at, at + removed);
  const std::vector<Instance> more = random_parts(dice, dice.below(dice.chance(0.15) ? 30 : 4), size);
  next.insert(rest, more.begin(), more.end());
  return next;
}

struct Chain {
  VolumeTarget target;
  std::unique_ptr<TargetScratch> scratch = target.make_scratch(), other = target.make_scratch();
  std::unique_ptr<TargetSession> session = target.make_session();
  std::vector<Instance> state;
  int counted = 0;

  explicit Chain(VolumeSettings settings) : target(std::move(settings), test_meshes()) {}

  double whole(const Model& model) { return target.score(Derivation(), model, other.get()); }
  double by_change(const Model& model) {
    const double score =
        session->score(Derivation(), model, find_change(state, model.instances), scratch.get());
    counted += session->counted_change();
    return score;
  }
  void commit(const Model& model) {
    session->commit();
    state = model.instances;
  }
};

/// How many of the scores were got by the difference.
int expect_equal_scores(std::uint32_t number, int steps, float size) {
  Dice dice(number);
  Chain chain(settings_of(number));
  chain.state = random_parts(dice, 40 + dice.below(40), size);
  for (int step = 0; step < steps; ++step) {
    Model next;
    next.instances = propose(dice, chain.state, size);
    EXPECT_EQ(chain.by_change(next), chain.whole(next)) << "model " << number << ", step " << step;
    if (dice.chance(0.4)) chain.commit(next);
    if (dice.chance(0.02)) chain.session->restart();
    if (dice.chance(0.01)) {
      chain.state = random_parts(dice, 50, size);
      chain.session->restart();
    }
  }
  return chain.counted;
}

RC_GTEST_PROP(VolumeSession, ScoresAsWholeModelsDo, ()) {
  const auto number = *rc::gen::inRange<std::uint32_t>(0, 1'000'000);
  expect_equal_scores(number, 40, 0.8f);
  RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(VolumeSession, EveryInstructionSetScoresAsWholeModelsDo) {
  const std::vector<std::string> paths = kernel_paths();
  ASSERT_GE(paths.size(), 2u);
  for (const std::string& path : paths) {
    use_kernel_path(path);
    int counted = 0;
    for (std::uint32_t number = 0; number < 12; ++number) counted += expect_equal_scores(number, 25, 0.8f);
    EXPECT_GT(counted, 12 * 25 / 2) << path;
  }
  use_kernel_path("");
}

constexpr std::size_t kMost = (std::size_t{1} << kCountPlanes) - 1;  // parts on each other

/// A grid of 10 x 10 x 10 cubes, `wanted` 4 x 4 x 4 of them; 32 boxes beside each other.
VolumeSettings cubes() {
  VolumeSettings s;
  s.grid = {Vec3(0), Vec3(10), {10, 10, 10}};
  s.meshes.push_back({"wanted", box_mesh(Vec3(0), Vec3(4)), 1, std::nullopt});
  s.overlap_weight = 0.25;
  return s;
}

std::vector<Instance> row_of_boxes(float z) {
  std::vector<Instance> parts;
  for (int i = 0; i < 32; ++i) {
    const Vec3 low(static_cast<float>(i % 8), static_cast<float>(i / 8 * 2), z);
    parts.push_back(part(kBox, box_frame(low, low + Vec3(1, 1, 2))));
  }
  return parts;
}

TEST(VolumeSession, CountsByHand) {
  Chain chain(cubes());
  chain.state = row_of_boxes(0);
  Model next;
  next.instances = chain.state;
  next.instances[0].model_from_mesh.origin.x += 4;  // out of the target, onto the box there
  EXPECT_EQ(chain.by_change(next), 14.0 - 48 - 0.25 * 2);  // 14 voxels inside, 62 covered
  EXPECT_TRUE(chain.session->counted_change());
  next.instances = chain.state;
  EXPECT_EQ(chain.by_change(next), 16.0 - 48);
  EXPECT_TRUE(chain.session->counted_change());
}

TEST(VolumeSession, ScoresPilesThatItCannotCountAsAWhole) {
  Chain chain(cubes());
  chain.state = row_of_boxes(0);
  Model next;
  for (std::size_t piled = 1; piled < kMost + 25; ++piled) {  // in a model that grows
    next.instances = chain.state;
    const std::vector<Instance> more = row_of_boxes(4);
    next.instances.insert(next.instances.end(), more.begin(), more.begin() + 3);
    next.instances.push_back(chain.state[0]);
    ASSERT_EQ(chain.by_change(next), chain.whole(next)) << piled;
    EXPECT_EQ(chain.session->counted_change(), piled < kMost) << piled;
    chain.commit(next);
  }
}

TEST(VolumeSession, GoesOnCountingOnceAPileIsGone) {
  Chain chain(cubes());
  chain.state = row_of_boxes(0);
  const auto pile = [&](std::size_t count) {
    Model model;
    model.instances = chain.state;
    model.instances.resize(32);
    for (std::size_t i = 0; i < count; ++i) model.instances.push_back(chain.state[0]);
    return model;
  };
  const auto score_and_commit = [&](const Model& model) {
    EXPECT_EQ(chain.by_change(model), chain.whole(model));
    const bool counted = chain.session->counted_change();
    chain.commit(model);
    return counted;
  };
  for (std::size_t piled = 1; piled < kMost; ++piled) EXPECT_TRUE(score_and_commit(pile(piled)));
  EXPECT_FALSE(score_and_commit(pile(kMost)));  // and the one below
  EXPECT_FALSE(score_and_commit(pile(kMost + 1)));
  int waited = 0;
  while (waited < 200 && !score_and_commit(pile(kMost - 1))) ++waited;
  EXPECT_LT(waited, 70);
  EXPECT_TRUE(score_and_commit(pile(kMost - 1)));
}

TEST(VolumeSession, SmallModelsAndLargeChangesAreScoredAsAWhole) {
  Chain chain(cubes());
  chain.state = row_of_boxes(0);
  chain.state.resize(VolumeSession::kFewestParts - 1);
  Model next;
  next.instances = chain.state;
  chain.by_change(next);
  EXPECT_FALSE(chain.session->counted_change());
  chain.state = row_of_boxes(0);
  chain.session->restart();
  next.instances = row_of_boxes(4);
  EXPECT_EQ(chain.by_change(next), chain.whole(next));
  EXPECT_FALSE(chain.session->counted_change());
}

/// Refuses models of more than 42 parts.
class FewParts final : public Target {
 public:
  const std::string& name() const override { return name_; }
  TargetView view() const override { return TargetView::full; }
  bool may_reject() const override { return true; }
  double score(const Derivation&, const Model& model, TargetScratch*) const override {
    return model.instances.size() > 42 ? -std::numeric_limits<double>::infinity()
                                       : 0.01 * static_cast<double>(model.instances.size());
  }
  double optimum() const override { return 0.42; }
  Explanation explain(const Derivation&, const Model&, TargetScratch*) const override { return {}; }

 private:
  std::string name_ = "few parts";
};

TEST(ObjectiveSession, ScoresAsTheObjectiveDoesAlongAChain) {
  Objective objective;
  objective.add(std::make_unique<VolumeTarget>(settings_of(0), test_meshes()), 0.9);
  objective.add(std::make_unique<FewParts>(), 1.1);
  objective.add(std::make_unique<VolumeTarget>(settings_of(7), test_meshes()), 0.6);
  EXPECT_GT(objective.session_bytes(), 0u);
  Dice dice(5);
  Objective::Scratch scratch(objective), other(objective);
  Objective::Session session(objective);
  Model state;
  state.instances = random_parts(dice, 40, 0.6f);
  session.begin(state);
  int counted = 0, refused = 0;
  for (int step = 0; step < 300; ++step) {
    Model next;
    next.instances = propose(dice, state.instances, 0.6f);
    const double score = objective.score(Derivation(), next, scratch, session);
    ASSERT_EQ(score, objective.score(Derivation(), next, other)) << step;
    if (score == -std::numeric_limits<double>::infinity()) {
      ++refused;
      continue;
    }
    counted += session.counted_change();
    if (next.instances.size() >= 38 && dice.chance(0.5)) session.commit(), state = next;
  }
  EXPECT_GT(counted, 50);
  EXPECT_GT(refused, 20);
}

TEST(ObjectiveSession, IsOfNoUseWithoutAVolume) {
  Objective objective;
  objective.add(std::make_unique<FewParts>());
  EXPECT_EQ(objective.session_bytes(), 0u);
}

}  // namespace
}  // namespace espalier
