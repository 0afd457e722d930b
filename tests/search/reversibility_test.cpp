// Detailed balance: from exact draws of the posterior, every kind of move goes from x to y as often as from y to x.
// Each kind by itself, first the proposals with a plain rule of acceptance, then the engine.
#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "base/natural_exp.h"
#include "derivation/nudge.h"
#include "derivation/proposal.h"
#include "derivation/sample.h"
#include "search/acceptance.h"
#include "search/exact_posterior.h"
#include "search/rjmcmc.h"

namespace espalier {
namespace {

using testing::Balance;
using testing::cell_of;
using testing::ExactPosterior;
using testing::tiny_graph;
using testing::tiny_score;

constexpr double kBeta = 1;
constexpr int kSteps = 40'000;

/// Changes a derivation, or leaves it: one step of a chain.
using Step = std::function<void(Derivation&, RandomStream&)>;

/// How far ways and ways back are apart: above 1 is too far.
double excess(const ExactPosterior& posterior, const Step& step, std::uint32_t parts) {
  const auto graph = tiny_graph();
  Balance cells, scores, sizes;
  RandomStream random({11, Purpose::test});
  for (int i = 0; i < kSteps; ++i) {
    const Derivation before = posterior.draw(random);
    Derivation after = before;
    step(after, random);
    cells.add(cell_of(*graph, before, parts), cell_of(*graph, after, parts));
    scores.add_step(tiny_score(*graph, before), tiny_score(*graph, after));
    sizes.add_step(static_cast<double>(before.size()), static_cast<double>(after.size()));
  }
  EXPECT_GT(cells.pairs(), 20u);
  return std::max({cells.excess(), scores.excess(), sizes.pairs() > 0 ? sizes.excess() : 0});
}

using Propose = std::function<std::optional<double>(Derivation&, RandomStream&)>;

/// Accepts by the ratio that the proposal gives; `broken` leaves it out.
Step accepted(const Propose& propose, bool broken, double beta = kBeta) {
  return [=, graph = tiny_graph()](Derivation& at, RandomStream& random) {
    Derivation next = at;
    const std::optional<double> ratio = propose(next, random);
    if (!ratio) return;
    const double rise = tiny_score(*graph, next) - tiny_score(*graph, at);
    if (random.next_unit() < natural_exp((broken ? 0 : *ratio) + beta * rise)) at = std::move(next);
  };
}

class Reversibility : public ::testing::TestWithParam<PlaceChoice> {
 protected:
  Propose jump(std::uint32_t most = 1000) const {
    return [=, this](Derivation& d, RandomStream& random) {
      return propose_jump(*graph_, d, {}, GetParam(), most, random);
    };
  }
  Propose slot(std::uint32_t most = 1000) const {
    return [=, this](Derivation& d, RandomStream& random) {
      return propose_slot(*graph_, d, {}, GetParam(), most, random);
    };
  }
  Propose draws(DrawStep step) const {
    return [=, this](Derivation& d, RandomStream& random) {
      return propose_draws(*graph_, d, {}, GetParam(), step, random);
    };
  }
  const std::shared_ptr<const GeneratorGraph> graph_ = tiny_graph();
  const ExactPosterior posterior_{graph_, kBeta};
};

// Two parts of every draw: those that are kept, dropped and drawn anew must balance too.
TEST_P(Reversibility, OfJumps) { EXPECT_LT(excess(posterior_, accepted(jump(), false), 2), 1); }
TEST_P(Reversibility, OfSlots) { EXPECT_LT(excess(posterior_, accepted(slot(), false), 2), 1); }
TEST_P(Reversibility, OfDraws) { EXPECT_LT(excess(posterior_, accepted(draws(DrawStep::fresh), false), 4), 1); }
TEST_P(Reversibility, OfNudges) { EXPECT_LT(excess(posterior_, accepted(draws(DrawStep::local), false), 4), 1); }

TEST_P(Reversibility, WithinGeneLimits) {
  const ExactPosterior small(graph_, kBeta, 5);
  EXPECT_LT(excess(small, accepted(jump(5), false), 2), 1);
  EXPECT_LT(excess(small, accepted(slot(5), false), 2), 1);
}

TEST_P(Reversibility, ABrokenRatioIsSeen) {
  EXPECT_GT(excess(posterior_, accepted(jump(), true), 2), 2);
  EXPECT_GT(excess(posterior_, accepted(slot(), true), 2), 2);
}

// Of draws the ratio is 0, so what can break is what they are accepted for.
TEST_P(Reversibility, ABrokenAcceptanceIsSeen) {
  EXPECT_GT(excess(posterior_, accepted(draws(DrawStep::fresh), false, 0.7 * kBeta), 4), 2);
  const ExactPosterior cold(graph_, 4);  // nudges are small: what they change must count
  EXPECT_LT(excess(cold, accepted(draws(DrawStep::local), false, 4), 4), 1);
  EXPECT_GT(excess(cold, accepted(draws(DrawStep::local), false, 2), 4), 1.5);
}

INSTANTIATE_TEST_SUITE_P(Search, Reversibility, ::testing::Values(PlaceChoice::uniform, PlaceChoice::by_level),
                         [](const auto& choice) {
                           return choice.param == PlaceChoice::uniform ? "Uniform" : "ByLevel";
                         });

/// The excess of chains of one draw u under exp(beta u): fresh draws, and where they are rejected a nudge; `broken`
/// forgets that the way back would have been rejected first too.
double excess_of_delayed_nudges(bool broken) {
  constexpr double kCold = 5;  // much is rejected
  test::GraphBuilder b("one");
  b.rule("Root", 1);
  const GeneratorGraph graph = b.build();
  RandomStream random({13, Purpose::test});
  const Derivation root = sample(graph, random).derivation;
  const auto score = [](const Derivation& d) { return 0x1p-32 * d.draws[0]; };
  Balance cells, steps;
  for (int i = 0; i < 600'000; ++i) {
    Derivation at = root;
    at.draws[0] = testing::exact_draw(kCold, random);
    Derivation next = at;
    std::uint32_t gene = 0;
    EXPECT_TRUE(propose_draws(graph, next, {}, PlaceChoice::uniform, DrawStep::fresh, random, &gene));
    const double rejected = score(next);
    bool taken = random.next_unit() < natural_exp(kCold * (rejected - score(at)));
    if (!taken) {
      next = at;
      nudge_gene(graph, next, gene, random);
      const double more = broken ? 0 : log_delayed_ratio(kCold, score(at), rejected, score(next));
      taken = random.next_unit() < natural_exp(kCold * (score(next) - score(at)) + more);
    }
    if (!taken) continue;
    const auto cell = [](const Derivation& d) { return std::string(1, static_cast<char>('a' + (d.draws[0] >> 28))); };
    cells.add(cell(at), cell(next));
    steps.add_step(score(at), score(next));
  }
  return std::max(cells.excess(), steps.excess());
}

TEST(ReversibilityOfDelayedNudges, HoldsWithItsRatioAndNotWithout) {
  EXPECT_LT(excess_of_delayed_nudges(false), 1);
  EXPECT_GT(excess_of_delayed_nudges(true), 1.5);
}

// Draws that wrap, and those of few values: nudges of these have rules of their own.
TEST(ReversibilityOfNudges, HoldsForEveryShapeOfDraw) {
  test::GraphBuilder b("shapes");
  b.rule("Root", 3);
  GeneratorGraph graph = b.build();
  graph.rules[0].draws[1].shape = DrawShape::circular;
  graph.rules[0].draws[2].shape = DrawShape::discrete;
  graph.rules[0].draws[2].values = 5;
  const auto score = [](const Derivation& d) {
    return 0x1p-32 * d.draws[0] + 0x1p-32 * d.draws[1] + 0x1p-32 * d.draws[2];
  };
  for (const double broken : {1.0, 0.6}) {
    RandomStream random({12, Purpose::test});
    const Derivation root = sample(graph, random).derivation;
    Balance cells, steps;
    for (int i = 0; i < 200'000; ++i) {
      Derivation at = root;
      for (std::uint32_t& draw : at.draws) draw = testing::exact_draw(2, random);
      Derivation next = at;
      ASSERT_TRUE(propose_draws(graph, next, {}, PlaceChoice::uniform, DrawStep::local, random));
      if (random.next_unit() < natural_exp(2 * broken * (score(next) - score(at)))) {
        cells.add(cell_of(graph, at, 5), cell_of(graph, next, 5));
        steps.add_step(score(at), score(next));
      }
    }
    const double excess = std::max(cells.excess(), steps.excess());
    EXPECT_EQ(excess > 1, broken != 1) << excess;
  }
}

/// One step of the engine from `at`, with one chain. Scores go to `scorer`.
struct EngineStep {
  std::function<void(RjmcmcSettings&)> only;  // the kinds that are proposed
  double beta = kBeta;

  Step step() const {
    RjmcmcSettings s;
    s.chains = s.temperatures = 1;
    s.temperature = 1 / beta;
    s.draws = s.nudges = s.slots = s.jumps = 0;
    s.delayed = false;
    s.genes = {1, 1000};
    s.initial_length_min = s.initial_length_max = 1;
    only(s);
    const auto graph = tiny_graph();
    const auto scorer = std::make_shared<testing::TinyScorer>(graph);
    return [=, seed = std::uint64_t{0}](Derivation& at, RandomStream&) mutable {
      RjmcmcEngine engine({graph, {}, scorer.get(), ++seed, 0, {{at, tiny_score(*graph, at)}}}, s);
      engine.step();
      engine.step();
      at = engine.population()[0].derivation;
    };
  }
};

TEST(ReversibilityOfTheEngine, HoldsForEveryKind) {
  const ExactPosterior posterior(tiny_graph(), kBeta);
  const auto of = [&](std::uint32_t parts, std::function<void(RjmcmcSettings&)> only, double beta = kBeta) {
    return excess(posterior, EngineStep{std::move(only), beta}.step(), parts);
  };
  EXPECT_LT(of(2, [](RjmcmcSettings& s) { s.jumps = 1; }), 1);
  EXPECT_LT(of(2, [](RjmcmcSettings& s) { s.slots = 1; }), 1);
  EXPECT_LT(of(4, [](RjmcmcSettings& s) { s.nudges = 1; }), 1);
  EXPECT_LT(of(4, [](RjmcmcSettings& s) { s.draws = 1; }), 1);
  EXPECT_LT(of(4, [](RjmcmcSettings& s) { s.draws = 1, s.delayed = true; }), 1);
  // And at another temperature for none of them.
  EXPECT_GT(of(2, [](RjmcmcSettings& s) { s.jumps = 1; }, 0.7), 1.5);
  EXPECT_GT(of(4, [](RjmcmcSettings& s) { s.draws = 1, s.delayed = true; }, 0.7), 1.5);
}

}  // namespace
}  // namespace espalier
