#include "search/selection.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace espalier {
namespace {

// Pearson's statistic of picks against probabilities worked out by hand; entries of probability 0 must stay at 0.
double chi_square(SelectionScheme scheme, std::uint32_t k, const std::vector<double>& scores,
                  const std::vector<double>& expected) {
  constexpr int kPicks = 100'000;
  Selection selection(scheme, k);
  selection.prepare(scores);
  RandomStream random({11, Purpose::test});
  std::vector<int> counts(scores.size());
  for (int i = 0; i < kPicks; ++i) ++counts[selection.pick(random)];
  double chi2 = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] == 0) {
      EXPECT_EQ(counts[i], 0) << "index " << i << " can never be picked";
    } else {
      const double mean = kPicks * expected[i];
      chi2 += (counts[i] - mean) * (counts[i] - mean) / mean;
    }
  }
  return chi2;
}

// 99.9 % points of chi-square with 1, 2, 3, 4 degrees of freedom: 10.83, 13.82, 16.27, 18.47.

TEST(Selection, RouletteWeighsByTheDistanceToTheWorst) {
  // f - worst = 5, 3, 0, 2
  EXPECT_LT(chi_square(SelectionScheme::roulette, 1, {2, 0, -3, -1}, {0.5, 0.3, 0, 0.2}), 13.82);
}

TEST(Selection, RouletteOfEqualScoresIsUniform) {
  EXPECT_LT(chi_square(SelectionScheme::roulette, 1, {-7, -7, -7, -7}, {0.25, 0.25, 0.25, 0.25}), 16.27);
}

TEST(Selection, RouletteNeverPicksTheWorstHoweverSmallTheOthers) {
  EXPECT_LT(chi_square(SelectionScheme::roulette, 1, {0, 1e-300, 0, 0}, {0, 1, 0, 0}), 1e-9);
}

TEST(Selection, TournamentOfThreeTakesTheBestDrawn) {
  // With n = 4 distinct scores the r-th best wins with ((5 - r)^3 - (4 - r)^3) / 4^3.
  EXPECT_LT(chi_square(SelectionScheme::tournament, 3, {10, 40, 20, 30}, {1 / 64., 37 / 64., 7 / 64., 19 / 64.}),
            16.27);
}

TEST(Selection, TournamentTiesGoToTheLowestIndex) {
  // Two of three: index 0 wins unless it is not drawn at all, index 2 only if it is drawn alone.
  EXPECT_LT(chi_square(SelectionScheme::tournament, 2, {5, 5, 5}, {5 / 9., 3 / 9., 1 / 9.}), 13.82);
}

TEST(Selection, TournamentOfOneIsUniform) {
  EXPECT_LT(chi_square(SelectionScheme::tournament, 1, {3, 1, 2}, {1 / 3., 1 / 3., 1 / 3.}), 13.82);
}

TEST(Selection, RandomIgnoresScores) {
  EXPECT_LT(chi_square(SelectionScheme::random, 10, {100, 1, 1, 1, 1}, {.2, .2, .2, .2, .2}), 18.47);
}

TEST(Selection, OneIndividualIsAlwaysPicked) {
  for (const auto scheme : {SelectionScheme::roulette, SelectionScheme::tournament, SelectionScheme::random}) {
    EXPECT_EQ(chi_square(scheme, 4, {-1.5}, {1}), 0) << name_of(scheme);
  }
}

TEST(Selection, PreparingAgainForgetsTheOldScores) {
  Selection selection(SelectionScheme::roulette, 1);
  selection.prepare(std::vector<double>{9, 0, 0, 0});
  selection.prepare(std::vector<double>{0, 1});
  RandomStream random({12, Purpose::test});
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(selection.pick(random), 1u);
}

}  // namespace
}  // namespace espalier
