// Rates of variation that follow what each kind brought.
#include <cmath>
#include <memory>
#include <numeric>

#include <gtest/gtest.h>

#include "search/engine_log.h"
#include "search/ga.h"
#include "search/ga_rates.h"
#include "search/test_graph.h"

namespace espalier {
namespace {

using testing::count_of;
using Kind = VariationKind;

double sum_of(const VariationRates& rates) { return std::accumulate(rates.chance.begin(), rates.chance.end(), 0.0); }

void add(GaGains& gains, Kind kind, int made, int better) {
  for (int i = 0; i < made; ++i) gains.add(kind, i < better);
}

TEST(GaRates, AreWhatTheSettingsSay) {
  GaSettings s = ga_preset("ga-2017");
  const VariationRates rates = rates_of(s);
  EXPECT_NEAR(rates.of(Kind::grow), 0.135, 1e-12);
  EXPECT_NEAR(rates.of(Kind::alter), 0.03, 1e-12);
  EXPECT_EQ(rates.of(Kind::nudge), 0);
  EXPECT_NEAR(rates.of(Kind::crossover), 0.7, 1e-12);
  s.mutation = 0;
  s.grow = s.cut = s.alter = 0;
  EXPECT_EQ(rates_of(s).of(Kind::crossover), 1);
  EXPECT_EQ(sum_of(rates_of(s)), 1);
}

TEST(GaRates, FollowWhatKindsBrought) {
  const VariationRates given = rates_of(ga_preset("ga-2017"));
  GaGains gains;
  gains.begin_generation();
  EXPECT_EQ(adapted(given, gains).chance, given.chance) << "nothing is known yet";
  add(gains, Kind::grow, 500, 0);
  add(gains, Kind::cut, 500, 100);
  add(gains, Kind::crossover, 2000, 40);
  const VariationRates rates = adapted(given, gains);
  EXPECT_NEAR(sum_of(rates), 1, 1e-12);
  EXPECT_EQ(rates.of(Kind::nudge), 0) << "what is never to happen never does";
  for (std::size_t k = 0; k < kVariationKinds; ++k) EXPECT_GE(rates.chance[k], given.chance[k] / 2);
  EXPECT_GT(rates.of(Kind::cut), 2 * given.of(Kind::cut));
  EXPECT_LT(rates.of(Kind::grow), 0.6 * given.of(Kind::grow));
  EXPECT_LT(rates.of(Kind::crossover), given.of(Kind::crossover));
  EXPECT_GT(rates.of(Kind::alter), given.of(Kind::alter)) << "not tried: as good as the mean";
}

/// What matters is draws: only nudges and alterations help.
class DrawScorer final : public BatchScorer {
 public:
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      double sum = 0;
      for (const std::uint32_t draw : derivations[i]->draws) sum += std::abs(draw * 0x1p-32 - 0.5);
      const auto n = static_cast<double>(derivations[i]->draws.size());
      scores[i] = -std::abs(n - 12) - (n > 0 ? sum / n : 0);
    }
  }
  double optimum() const override { return 0; }
};

GaSettings settings(bool adapt) {
  GaSettings s = ga_preset("ga-local");
  s.population = 40;
  s.elitism = 4;
  s.initial_length_min = s.initial_length_max = 10;
  s.genes = {1, 40};
  s.nudge = 0.1;
  s.adapt = adapt;
  return s;
}

struct Bench {
  explicit Bench(bool adapt = true, std::uint64_t seed = 5)
      : engine({testing::twig_graph(), {}, &scorer, seed, 0, {}}, settings(adapt)) {}
  DrawScorer scorer;
  GaEngine engine;
};

TEST(GaAdapt, MakesMoreOfWhatHelps) {
  Bench following, fixed(false);
  for (int i = 0; i < 60; ++i) following.engine.step(), fixed.engine.step();
  EXPECT_GT(count_of(following.engine, "nudged"), 2 * count_of(fixed.engine, "nudged"));
  EXPECT_LT(count_of(following.engine, "crossed pairs"), count_of(fixed.engine, "crossed pairs"));
}

TEST(GaAdapt, FindsMoreInAsManyEvaluations) {
  double gain = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Bench following(true, seed), fixed(false, seed);
    while (following.engine.evaluations() < 4000) following.engine.step();
    while (fixed.engine.evaluations() < 4000) fixed.engine.step();
    gain += following.engine.best().score - fixed.engine.best().score;
  }
  EXPECT_GT(gain, 0);
}

TEST(GaAdapt, SameSeedSameCourseAndGoesOnFromASavedState) {
  Bench a, b;
  EXPECT_EQ(testing::log_of(a.engine, 30), testing::log_of(b.engine, 30));
  testing::expect_saved_states_go_on([] { return std::make_unique<Bench>(); }, {0, 1, 7, 40}, 30);
}

TEST(GaAdapt, BelongsToTheSettingsOfAState) {
  Bench following, fixed(false);
  testing::expect_foreign_states_refused([] { return std::make_unique<Bench>(); }, fixed.engine, 3);
}

}  // namespace
}  // namespace espalier
