// Swaps between temperatures keep the joint distribution of a ladder: the product of the posteriors of its rungs.
// Ladders begin with exact draws, each of its own rung, and after a few steps pairs of neighbours must still be
// independent and each as its rung wants it.
#include <algorithm>
#include <array>
#include <memory>

#include <gtest/gtest.h>

#include "base/natural_exp.h"
#include "search/acceptance.h"
#include "search/exact_posterior.h"
#include "search/rjmcmc.h"

namespace espalier {
namespace {

using testing::excess;
using testing::ExactPosterior;
using testing::tiny_graph;
using testing::tiny_score;

constexpr double kHeat = 9;  // of three rungs: beta 1, 1/3, 1/9
constexpr int kLadders = 30'000;
constexpr double kBetas[] = {1, 1.0 / 3, 1.0 / 9};

/// What is told apart of a structure, so that pairs are a few hundred: how many genes, and how many of them are Buds.
std::string kind_of(const std::string& key) {
  const auto genes = std::count(key.begin(), key.end(), ' ');
  int buds = 0;
  for (std::size_t at = 0; at < key.size(); at = key.find(' ', at) + 1) buds += key[at] == '2' || key[at] == '3';
  return std::to_string(std::min<std::ptrdiff_t>(genes, 8)) + " genes " + std::to_string(buds) + " buds";
}

/// How often each pair of kinds was seen.
class Pairs {
 public:
  void add(const Derivation& cold, const Derivation& hot) {
    ++seen_[kind_of(test::key_of(*graph_, cold)) + ", " + kind_of(test::key_of(*graph_, hot))];
  }
  double excess_over(const ExactPosterior& cold, const ExactPosterior& hot) const {
    std::map<std::string, double> product;
    for (const auto& [a, p] : kinds(cold)) {
      for (const auto& [b, q] : kinds(hot)) product[a + ", " + b] = p * q;
    }
    return excess(product, seen_);
  }

 private:
  static std::map<std::string, double> kinds(const ExactPosterior& posterior) {
    std::map<std::string, double> sums;
    for (const auto& [key, share] : posterior.by_key()) sums[kind_of(key)] += share;
    return sums;
  }
  std::shared_ptr<const GeneratorGraph> graph_ = tiny_graph();
  std::map<std::string, int> seen_;
};

struct Ladder {
  const ExactPosterior rungs[3] = {{tiny_graph(), kBetas[0]}, {tiny_graph(), kBetas[1]}, {tiny_graph(), kBetas[2]}};
};
const Ladder& ladder() {
  static const Ladder made;
  return made;
}

/// Pairs of neighbours after `steps` steps of ladders that begin exactly right: 0-1 and 1-2.
std::array<Pairs, 2> after(int steps, double engine_heat) {
  const auto graph = tiny_graph();
  testing::TinyScorer scorer(graph);
  RjmcmcSettings s;
  s.chains = s.temperatures = 3;
  s.heat = engine_heat;
  s.temperature = 1;
  s.swap_every = 1;
  s.genes = {1, 1000};
  s.initial_length_min = s.initial_length_max = 1;
  std::array<Pairs, 2> pairs;
  std::uint64_t swaps = 0;
  for (int i = 0; i < kLadders; ++i) {
    RandomStream random({static_cast<std::uint64_t>(i), Purpose::test});
    std::vector<Individual> founders;
    for (const ExactPosterior& rung : ladder().rungs) founders.push_back({rung.draw(random), 0});
    for (Individual& founder : founders) founder.score = tiny_score(*graph, founder.derivation);
    RjmcmcEngine engine({graph, {}, &scorer, static_cast<std::uint64_t>(i), 0, founders}, s);
    for (int step = 0; step <= steps; ++step) engine.step();  // the first takes the founders
    const Derivation* at[3];
    for (std::size_t place = 0; place < 3; ++place) at[engine.rung_of(place)] = &engine.population()[place].derivation;
    pairs[0].add(*at[0], *at[1]);
    pairs[1].add(*at[1], *at[2]);
    swaps += engine.swaps(0).accepted + engine.swaps(1).accepted;
  }
  EXPECT_GT(swaps, 1000u);
  return pairs;
}

TEST(Tempering, LaddersKeepTheProductOfTheirPosteriors) {
  const std::array<Pairs, 2> pairs = after(2, kHeat);  // a swap of 1-2, then one of 0-1
  EXPECT_LT(pairs[0].excess_over(ladder().rungs[0], ladder().rungs[1]), 1);
  EXPECT_LT(pairs[1].excess_over(ladder().rungs[1], ladder().rungs[2]), 1);
}

TEST(Tempering, AnotherLadderWouldBeSeen) {
  EXPECT_GT(after(2, 3)[0].excess_over(ladder().rungs[0], ladder().rungs[1]), 1.5);
}

/// One swap of exact pairs by a rule of acceptance.
template <typename LogRatio>
double excess_after_swaps(LogRatio log_ratio) {
  const auto graph = tiny_graph();
  const ExactPosterior &cold = ladder().rungs[0], &hot = ladder().rungs[2];
  RandomStream random({21, Purpose::test});
  Pairs pairs;
  for (int i = 0; i < 60'000; ++i) {
    Derivation a = cold.draw(random), b = hot.draw(random);
    if (random.next_unit() < natural_exp(log_ratio(tiny_score(*graph, a), tiny_score(*graph, b)))) std::swap(a, b);
    pairs.add(a, b);
  }
  return pairs.excess_over(cold, hot);
}

TEST(Tempering, SwapsKeepTheJointDistributionAndBrokenOnesDoNot) {
  const auto right = [](double cold, double hot) { return log_swap_ratio(kBetas[0], kBetas[2], cold, hot); };
  EXPECT_LT(excess_after_swaps(right), 1);
  EXPECT_GT(excess_after_swaps([&](double cold, double hot) { return -right(cold, hot); }), 2);
  EXPECT_GT(excess_after_swaps([&](double cold, double hot) { return 0.7 * right(cold, hot); }), 2);
  EXPECT_GT(excess_after_swaps([](double, double) { return 0.0; }), 2);
}

// The test sees more than the two distributions: neighbours that are each right but not independent.
TEST(Tempering, DependentNeighboursAreSeen) {
  const ExactPosterior &cold = ladder().rungs[0], &hot = ladder().rungs[2];
  Pairs pairs;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    RandomStream one({i, Purpose::test}), same({i, Purpose::test});
    pairs.add(cold.draw(one), hot.draw(same));
  }
  EXPECT_GT(pairs.excess_over(cold, hot), 2);
}

}  // namespace
}  // namespace espalier
