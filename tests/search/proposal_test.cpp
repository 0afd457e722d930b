// The proposals of Markov chains, held against enumerated posteriors. (With the search's tests, for the tiny
// posterior.)
#include "derivation/proposal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "base/natural_exp.h"
#include "derivation/encode.h"
#include "derivation/random_derivation.h"
#include "derivation/sample.h"
#include "search/deviation.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

using testing::tiny_graph;
using testing::tiny_score;

constexpr double kBeta = 1;
constexpr std::uint32_t kAll = 1000;

using Propose = std::function<std::optional<double>(const GeneratorGraph&, Derivation&, RandomStream&)>;

struct Chain {
  explicit Chain(std::shared_ptr<const GeneratorGraph> g) : graph(std::move(g)) {}

  std::shared_ptr<const GeneratorGraph> graph;
  Derivation at;
  RandomStream random{{1, Purpose::test}};
  bool broken = false;  // the ratio is left out: what the tests must see
  double accepted = 0, steps = 0;

  void step(const Propose& propose) {
    Derivation next = at;
    const std::optional<double> ratio = propose(*graph, next, random);
    ++steps;
    if (!ratio) return;
    const double rise = tiny_score(*graph, next) - tiny_score(*graph, at);
    if (random.next_unit() >= natural_exp((broken ? 0 : *ratio) + kBeta * rise)) return;
    at = std::move(next);
    ++accepted;
  }
};

Propose draws(PlaceChoice choice, DrawStep step) {
  return
      [=](const GeneratorGraph& g, Derivation& d, RandomStream& r) { return propose_draws(g, d, {}, choice, step, r); };
}
Propose jump(PlaceChoice choice, std::uint32_t most = kAll) {
  return
      [=](const GeneratorGraph& g, Derivation& d, RandomStream& r) { return propose_jump(g, d, {}, choice, most, r); };
}
Propose slot(PlaceChoice choice, std::uint32_t most = kAll) {
  return
      [=](const GeneratorGraph& g, Derivation& d, RandomStream& r) { return propose_slot(g, d, {}, choice, most, r); };
}

/// How far the shares of time that a chain spends in the derivations lie from the posterior: the largest distance in
/// standard errors (of batch means).
double worst_deviation(Chain& chain, const std::vector<Propose>& moves, std::uint32_t most_genes) {
  constexpr int kBatches = 100, kSteps = 6000;
  testing::Deviation deviation(testing::shares(testing::tiny_posterior(*chain.graph, kBeta, most_genes)));
  do chain.at = sample(*chain.graph, chain.random).derivation;
  while (chain.at.size() > most_genes);
  for (int batch = 0; batch < kBatches; ++batch) {
    std::map<std::string, double> share;
    for (int i = 0; i < kSteps; ++i) {
      chain.step(moves[chain.random.below(static_cast<std::uint32_t>(moves.size()))]);
      share[test::key_of(*chain.graph, chain.at)] += 1.0 / kSteps;
    }
    deviation.add(share);
  }
  return deviation.worst(0.003);
}

constexpr double kBound = testing::kLargeDeviation;

class Proposals : public ::testing::TestWithParam<PlaceChoice> {};

TEST_P(Proposals, JumpsKeepThePosterior) {
  Chain chain(tiny_graph());
  EXPECT_LT(worst_deviation(chain, {jump(GetParam())}, kAll), kBound);
}

TEST_P(Proposals, SlotsKeepThePosterior) {
  // Alone they never change the variant of a gene that stays, but every gene can go and come.
  Chain chain(tiny_graph());
  EXPECT_LT(worst_deviation(chain, {slot(GetParam()), draws(GetParam(), DrawStep::fresh)}, kAll), kBound);
}

TEST_P(Proposals, AllTogetherKeepThePosterior) {
  const PlaceChoice c = GetParam();
  const std::vector<Propose> moves = {jump(c), slot(c), draws(c, DrawStep::fresh), draws(c, DrawStep::local)};
  Chain free(tiny_graph());
  EXPECT_LT(worst_deviation(free, moves, kAll), kBound);
  Chain limited(tiny_graph(1));
  EXPECT_LT(worst_deviation(limited, moves, kAll), kBound);
  const std::vector<Propose> small = {jump(c, 5), slot(c, 5), draws(c, DrawStep::fresh), draws(c, DrawStep::local)};
  Chain bounded(tiny_graph());
  EXPECT_LT(worst_deviation(bounded, small, 5), kBound);
}

TEST_P(Proposals, WithoutTheirRatioTheyWouldNot) {
  Chain jumping(tiny_graph()), sliding(tiny_graph());
  jumping.broken = sliding.broken = true;
  EXPECT_GT(worst_deviation(jumping, {jump(GetParam())}, kAll), 2 * kBound);
  EXPECT_GT(worst_deviation(sliding, {slot(GetParam()), draws(GetParam(), DrawStep::fresh)}, kAll), 2 * kBound);
}

INSTANTIATE_TEST_SUITE_P(Search, Proposals, ::testing::Values(PlaceChoice::uniform, PlaceChoice::by_level),
                         [](const auto& choice) {
                           return choice.param == PlaceChoice::uniform ? "Uniform" : "ByLevel";
                         });

// Draws alone: u of one gene under exp(beta u) has mean 1 / (1 - exp(-beta)) - 1 / beta.
TEST(ProposedDraws, FollowTheirDensity) {
  test::GraphBuilder b("one");
  b.rule("Root", 1);
  for (const DrawStep step : {DrawStep::fresh, DrawStep::local}) {
    Chain chain(std::make_shared<GeneratorGraph>(b.build()));
    chain.at = sample(*chain.graph, chain.random).derivation;
    double sum = 0;
    constexpr int kSteps = 400'000;
    for (int i = 0; i < kSteps; ++i) {
      chain.step(draws(PlaceChoice::uniform, step));
      sum += chain.at.draws[0] * 0x1p-32;
    }
    EXPECT_NEAR(sum / kSteps, 1 / (1 - std::exp(-kBeta)) - 1 / kBeta, 0.01);
  }
}

// The ratio backwards is minus the ratio forwards: prior and choice of the place turn round.
TEST(ProposalMoves, RatiosOfTheWayBackAreOpposite) {
  const auto graph = tiny_graph();
  RandomStream random({9, Purpose::test});
  std::map<std::pair<std::string, std::string>, std::set<double>> ratios;
  for (int i = 0; i < 20000; ++i) {
    Derivation d = sample(*graph, random).derivation;
    const std::string from = test::key_of(*graph, d);
    const auto ratio = propose_jump(*graph, d, {}, PlaceChoice::by_level, kAll, random);
    if (ratio) ratios[{from, test::key_of(*graph, d)}].insert(*ratio);
  }
  int both = 0;
  for (const auto& [way, there] : ratios) {
    const auto back = ratios.find({way.second, way.first});
    if (back == ratios.end()) continue;
    for (const double r : there) both += back->second.contains(-r);
  }
  EXPECT_GT(both, 100);
}

TEST(ProposalMoves, AreValidOnRandomGraphsAndRespectLocks) {
  int made = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    RandomStream random({seed, Purpose::test});
    const GeneratorGraph graph = test::random_graph(random);
    std::optional<Derivation> d = test::random_derivation(graph, random, 12);
    if (!d || !close_open_slots(graph, *d, random)) continue;
    const Locks locks = test::random_locks(graph, *d, random);
    const Derivation before = *d;
    for (int k = 0; k < 10; ++k) {
      Derivation next = *d;
      const PlaceChoice choice = random.chance(0.5) ? PlaceChoice::uniform : PlaceChoice::by_level;
      const std::uint32_t kind = random.below(4);
      const auto ratio = kind == 0   ? propose_jump(graph, next, locks, choice, 500, random)
                         : kind == 1 ? propose_slot(graph, next, locks, choice, 500, random)
                                     : propose_draws(graph, next, locks, choice,
                                                     kind == 2 ? DrawStep::fresh : DrawStep::local, random);
      if (!ratio) continue;
      ASSERT_EQ(find_fault(graph, next), "") << seed;
      ASSERT_TRUE(is_finished(next));
      ASSERT_LE(next.size(), 500u);
      *d = next;
      ++made;
    }
    test::expect_locks_kept(graph, before, *d, locks);
  }
  EXPECT_GT(made, 1000);
}

}  // namespace
}  // namespace espalier
