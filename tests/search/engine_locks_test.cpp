// Random locks of every scope hold in everything that any engine ever asks the scorer for, whatever the founders.
#include <memory>
#include <optional>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "derivation/encode.h"
#include "derivation/moves.h"
#include "derivation/nudge.h"
#include "derivation/random_derivation.h"
#include "search/ga.h"
#include "search/guided.h"
#include "search/hybrid.h"
#include "search/rjmcmc.h"
#include "search/smc.h"
#include "search/tiny_posterior.h"

namespace espalier {
namespace {

constexpr std::uint32_t kMostGenes = 60;

double score_of(const Derivation& derivation) {
  double score = static_cast<double>(derivation.size());
  for (const std::uint32_t draw : derivation.draws) score += draw * 0x1p-32;
  return score;
}

/// Looks at everything that it is asked.
class LockWatch final : public BatchScorer {
 public:
  LockWatch(const GeneratorGraph& graph, const Derivation& founder, const Locks& locks)
      : graph_(graph), founder_(founder), locks_(locks) {}
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      scores[i] = score_of(*derivations[i]);
      RC_ASSERT(find_fault(graph_, *derivations[i]) == "");
      test::expect_locks_kept(graph_, founder_, *derivations[i], locks_);
      RC_ASSERT(!::testing::Test::HasFailure());
      changed += !(*derivations[i] == founder_);
      ++asked;
    }
  }
  double optimum() const override { return 100; }
  std::uint64_t asked = 0, changed = 0;

 private:
  const GeneratorGraph& graph_;
  const Derivation& founder_;
  const Locks& locks_;
};

struct Setting {
  std::shared_ptr<const GeneratorGraph> graph;
  Locks locks;
  std::vector<Individual> founders;
  std::uint64_t seed = 0;
};

/// A random graph, a random derivation of it with one to three locks of any scope, and up to two more founders for
/// which these hold too. Nothing where the graph yields none.
std::optional<Setting> random_setting(std::uint64_t seed) {
  RandomStream random({seed, Purpose::test});
  Setting one;
  one.seed = seed;
  one.graph = testing::with_bones(test::random_graph(random));
  const GeneratorGraph& graph = *one.graph;
  std::optional<Derivation> first = test::random_derivation(graph, random, kMostGenes / 2);
  if (!first || !close_open_slots(graph, *first, random, kMostGenes)) return std::nullopt;
  if (first->size() < 3 || first->size() > kMostGenes) return std::nullopt;
  for (std::uint32_t n = 1 + random.below(3); n > 0; --n) {
    const std::uint32_t gene = random.below(static_cast<std::uint32_t>(first->size()));
    one.locks.push_back({gene_path(graph, *first, gene), static_cast<LockScope>(random.below(3))});
  }
  one.founders = {{*first, score_of(*first)}};
  for (std::uint32_t n = random.below(3); n > 0; --n) {
    Derivation other = *first;
    for (int k = 0; k < 6; ++k) {
      if (random.chance(0.5)) grow(graph, other, one.locks, random);
      else alter(graph, other, one.locks, random);
    }
    if (is_finished(other) && other.size() <= kMostGenes) one.founders.push_back({other, score_of(other)});
  }
  return one;
}

template <typename Settings>
Settings small(Settings s) {
  s.genes = {1, kMostGenes};
  s.initial_length_min = 1, s.initial_length_max = kMostGenes;
  return s;
}

GaSettings ga_settings() {
  GaSettings s = small(ga_preset("ga-local"));
  s.population = 12;
  s.elitism = 2;
  s.join = true;
  s.restart_after = 4;
  s.crossover = Compatibility::symbol;
  return s;
}

SmcSettings smc_settings(SlotOrder order) {
  SmcSettings s = small(SmcSettings());
  s.order = order;
  s.particles = 10;
  return s;
}

RjmcmcSettings rjmcmc_settings() {
  RjmcmcSettings s = small(RjmcmcSettings());
  s.chains = 6;
  s.temperatures = 3;
  s.swap_every = 2;
  s.temperature = 1;
  return s;
}

GuidedSettings guided_settings() {
  GuidedSettings s;
  s.genes = {1, kMostGenes};
  s.particles = s.last_particles = 6;
  s.steps = 8;
  s.regrow_particles = 4;
  s.regrow_steps = 5;
  return s;
}

std::unique_ptr<Engine> make_engine(int which, const SearchProblem& problem) {
  switch (which) {
    case 0: return std::make_unique<GaEngine>(problem, ga_settings());
    case 1: return std::make_unique<SmcEngine>(problem, smc_settings(SlotOrder::depth_first));
    case 2: return std::make_unique<SmcEngine>(problem, smc_settings(SlotOrder::random));
    case 3: return std::make_unique<RjmcmcEngine>(problem, rjmcmc_settings());
    case 4: return std::make_unique<GuidedEngine>(problem, guided_settings());
    default: break;
  }
  HybridSettings hybrid;
  hybrid.start = smc_settings(SlotOrder::random), hybrid.middle = ga_settings(), hybrid.end = rjmcmc_settings();
  hybrid.turn = 150;
  return std::make_unique<HybridEngine>(problem, hybrid);
}

constexpr const char* kNames[] = {"Ga", "Smc", "Sosmc", "Rjmcmc", "Guided", "Hybrid"};

class EngineLocks : public ::testing::TestWithParam<int> {};

TEST_P(EngineLocks, HoldWhateverIsLocked) {
  std::uint64_t asked = 0, changed = 0;
  const bool passed = rc::check([&](std::uint64_t seed) {
    const std::optional<Setting> one = random_setting(seed);
    RC_PRE(one.has_value());
    const Derivation& founder = one->founders[0].derivation;
    LockWatch watch(*one->graph, founder, one->locks);
    const std::unique_ptr<Engine> engine =
        make_engine(GetParam(), {one->graph, one->locks, &watch, one->seed >> 2, 0, one->founders});
    for (int step = 0; step < 25; ++step) engine->step();
    for (const Individual& member : engine->population()) {
      test::expect_locks_kept(*one->graph, founder, member.derivation, one->locks);
    }
    test::expect_locks_kept(*one->graph, founder, engine->best().derivation, one->locks);
    RC_ASSERT(!::testing::Test::HasFailure());
    RC_ASSERT(engine->best().score >= one->founders[0].score);
    asked += watch.asked, changed += watch.changed;
  });
  EXPECT_TRUE(passed);
  EXPECT_GT(asked, 2000u);
  EXPECT_GT(changed, asked / 4) << "locks that hold everything prove nothing";
}

INSTANTIATE_TEST_SUITE_P(Search, EngineLocks, ::testing::Range(0, 6),
                         [](const auto& which) { return kNames[which.param]; });

}  // namespace
}  // namespace espalier
