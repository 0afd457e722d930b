// Sessions of a scene: chains of the engine's own proposals on shipped grammars, and whole searches, against the same
// without sessions. Every score and every byte must be the same.
#include <algorithm>
#include <cctype>

#include <gtest/gtest.h>

#include "derivation/moves.h"
#include "derivation/proposal.h"
#include "derivation/sample.h"
#include "io/mesh_import.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"
#include "run/setup.h"
#include "search/engine_log.h"
#include "search/rjmcmc.h"

namespace espalier {
namespace {

using testing::log_of;

std::unique_ptr<Setup> load(const std::string& scene) {
  AssimpMeshSource source;
  return set_up(load_scene(std::string(ESPALIER_SOURCE_DIR) + "/scenes/" + scene), source);
}

Derivation large(const GeneratorGraph& graph, std::size_t genes, RandomStream& random) {
  Derivation made = seedling(graph, random);
  close_open_slots(graph, made, random);
  for (int i = 0; i < 20'000 && made.size() < genes; ++i) grow(graph, made, {}, random);
  return made;
}

/// One proposal of a random kind; false if there is none.
bool propose(const GeneratorGraph& graph, Derivation& next, RandomStream& random) {
  const Locks none;
  switch (random.below(4)) {
    case 0: return propose_jump(graph, next, none, PlaceChoice::uniform, 2000, random).has_value();
    case 1: return propose_slot(graph, next, none, PlaceChoice::uniform, 2000, random).has_value();
    case 2: return propose_draws(graph, next, none, PlaceChoice::uniform, DrawStep::fresh, random).has_value();
    default: return propose_draws(graph, next, none, PlaceChoice::uniform, DrawStep::local, random).has_value();
  }
}

class ShippedChains : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedChains, ScoreAsWholeModelsDo) {
  const auto setup = load(GetParam());
  const GeneratorGraph& graph = setup->graph();
  const auto executor = make_serial_executor();
  SceneScorer scorer(graph, setup->objective, *executor), whole(graph, setup->objective, *executor);
  const auto session = scorer.make_session();
  ASSERT_TRUE(session);
  RandomStream random({20261122, Purpose::test, 9});
  Derivation state = large(graph, 150, random);
  session->begin(state);
  int scored = 0;
  for (int step = 0; step < 300; ++step) {
    Derivation next = state;
    if (!propose(graph, next, random)) continue;
    const ScoreProposal proposal = {session.get(), &next};
    const Derivation* const plain = &next;
    double by_change = 0, expected = 0;
    scorer.score_proposals({&proposal, 1}, {&by_change, 1});
    whole.score({&plain, 1}, {&expected, 1});
    ASSERT_EQ(by_change, expected) << "step " << step;
    ++scored;
    if (expected == kNotAcceptable || next.size() < 40 || !random.chance(0.4)) continue;
    session->commit();
    state = std::move(next);
  }
  EXPECT_GT(scored, 150);
}

INSTANTIATE_TEST_SUITE_P(Run, ShippedChains,
                         ::testing::Values("spaceship.toml", "citadel.toml", "spaceship-2016.toml", "tree-crown.toml",
                                           "city-castle.toml"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::replace_if(name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

/// Hides the sessions of a scorer.
class WholeScorer final : public BatchScorer {
 public:
  explicit WholeScorer(BatchScorer& scorer) : scorer_(scorer) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    scorer_.score(derivations, scores);
  }
  double optimum() const override { return scorer_.optimum(); }
  std::string describe_rejections() const override { return scorer_.describe_rejections(); }

 private:
  BatchScorer& scorer_;
};

RjmcmcSettings settings(bool tempered) {
  RjmcmcSettings s;
  s.chains = 6;
  s.temperatures = tempered ? 3 : 1;
  s.swap_every = 3;
  s.delayed = true;
  s.initial_length_min = 20, s.initial_length_max = 60;
  s.genes = {1, 400};
  s.temperature = 0.01;
  return s;
}

enum class Sessions { none, all, some };

/// A search of a scene, with and without sessions.
struct Search {
  Search(const Setup& setup, int threads, Sessions sessions, bool tempered = true)
      : executor(make_thread_executor(threads)),
        scorer(setup.graph(), setup.objective, *executor,
               sessions == Sessions::some ? 3 * setup.objective.session_bytes() : kSessionBytes),
        whole(scorer),
        engine({setup.grammar.graph, {}, sessions == Sessions::none ? &whole : static_cast<BatchScorer*>(&scorer), 5},
               settings(tempered)) {}

  std::unique_ptr<Executor> executor;
  SceneScorer scorer;
  WholeScorer whole;
  RjmcmcEngine engine;
};

std::string saved(const Search& search) {
  std::ostringstream out;
  search.engine.save(out);
  return out.str();
}

TEST(SceneSessions, ASearchIsTheSameWithAndWithoutThem) {
  for (const char* scene : {"spaceship.toml", "citadel.toml"}) {
    const auto setup = load(scene);
    for (const bool tempered : {false, true}) {
      Search plain(*setup, 1, Sessions::none, tempered);
      const std::string expected = log_of(plain.engine, 150), state = saved(plain);
      for (const int threads : {1, 2}) {
        Search with(*setup, threads, Sessions::all, tempered);
        EXPECT_EQ(log_of(with.engine, 150), expected) << scene << ", " << threads << " threads";
        EXPECT_EQ(saved(with), state);
        EXPECT_EQ(with.scorer.describe_rejections(), plain.scorer.describe_rejections());
      }
      Search some(*setup, 2, Sessions::some, tempered);
      EXPECT_EQ(log_of(some.engine, 150), expected) << scene << ", sessions for half of the chains";
    }
  }
}

TEST(SceneSessions, ASearchGoesOnWhereItWasSaved) {
  const auto setup = load("spaceship.toml");
  Search whole(*setup, 1, Sessions::none), first(*setup, 1, Sessions::all), second(*setup, 1, Sessions::all);
  log_of(whole.engine, 60);
  log_of(first.engine, 60);
  log_of(second.engine, 20);  // its sessions hold other states
  std::stringstream state;
  first.engine.save(state);
  second.engine.load(state);
  const std::string expected = log_of(whole.engine, 60);
  EXPECT_EQ(log_of(second.engine, 60), expected);
  EXPECT_EQ(log_of(first.engine, 60), expected);
}

TEST(SceneSessions, KeepToTheirBudget) {
  const auto setup = load("spaceship.toml");
  const auto executor = make_serial_executor();
  const std::size_t bytes = setup->objective.session_bytes();
  SceneScorer scorer(setup->graph(), setup->objective, *executor, 2 * bytes + bytes / 2);
  auto first = scorer.make_session(), second = scorer.make_session();
  EXPECT_TRUE(first && second);
  EXPECT_FALSE(scorer.make_session());
  first.reset();
  EXPECT_TRUE(scorer.make_session());
}

TEST(SceneSessions, AreOfNoUseToSilhouettes) {
  const auto setup = load("tree-circle.toml");
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor);
  EXPECT_FALSE(scorer.make_session());
}

}  // namespace
}  // namespace espalier
