#include "run/statistics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace espalier {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

// By hand: 1 2 4 8 10: mean 5, squares 16 9 1 9 25 = 60, over 4 = 15.
TEST(Statistics, SummariesAreThoseWorkedOutByHand) {
  const SampleSummary s = summarise({8, 1, 4, 10, 2});
  EXPECT_EQ(s.count, 5u);
  EXPECT_EQ(s.median, 4);
  EXPECT_EQ(s.mean, 5);
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(15.0));
  EXPECT_EQ(s.lower, 2);
  EXPECT_EQ(s.upper, 8);
  EXPECT_EQ(s.iqr(), 6);
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.max, 10);
  const SampleSummary even = summarise({4, 1, 3, 2});
  EXPECT_EQ(even.median, 2.5);
  EXPECT_EQ(even.lower, 1.75);
  EXPECT_EQ(even.upper, 3.25);
  const SampleSummary one = summarise({7});
  EXPECT_EQ(one.median, 7);
  EXPECT_EQ(one.deviation, 0);
  EXPECT_EQ(one.iqr(), 0);
}

TEST(Statistics, WhatCameToNothingIsTheWorst) {
  const SampleSummary most = summarise({5, kNothing, 6});
  EXPECT_EQ(most.median, 5);
  EXPECT_FALSE(std::isfinite(most.mean));
  EXPECT_EQ(most.lower, kNothing);
  EXPECT_EQ(summarise({kNothing, kNothing, 6}).median, kNothing);
  EXPECT_EQ(rank_test(std::vector{1.0, kNothing}, std::vector{kNothing, 1.0}), 1);
}

// Of the 20 ways to choose 3 of 6 ranks, the two furthest apart are 1 2 3 and 4 5 6; sums of 7 and of 14 come once
// each as well.
TEST(Statistics, TheRankTestIsExact) {
  const std::vector<double> low = {1, 2, 3}, high = {4, 5, 6};
  EXPECT_DOUBLE_EQ(rank_test(low, high), 2.0 / 20);
  EXPECT_DOUBLE_EQ(rank_test(high, low), 2.0 / 20);
  EXPECT_DOUBLE_EQ(rank_test(std::vector{1.0, 2.0, 4.0}, std::vector{3.0, 5.0, 6.0}), 4.0 / 20);
  EXPECT_DOUBLE_EQ(rank_test(std::vector{1.0, 3.0, 6.0}, std::vector{2.0, 4.0, 5.0}), 1);  // sums 10 and 11
  EXPECT_DOUBLE_EQ(least_rank_test(5, 5), 2.0 / 252);
  EXPECT_DOUBLE_EQ(least_rank_test(1, 1), 1);
  EXPECT_DOUBLE_EQ(least_rank_test(2, 3), 2.0 / 10);
}

// 1 and 2 against 2 and 3: ranks 1, 2.5 and 2.5, 4. Sums of two of {1, 2.5, 2.5, 4}: 3.5 3.5 5 5 6.5 6.5; at least 1.5
// from 5: four of the six.
TEST(Statistics, TiesShareTheirRank) {
  EXPECT_DOUBLE_EQ(rank_test(std::vector{1.0, 2.0}, std::vector{2.0, 3.0}), 4.0 / 6);
  EXPECT_DOUBLE_EQ(rank_test(std::vector{7.0, 7.0, 7.0}, std::vector{7.0, 7.0}), 1);
}

// Against every choice of five of ten, tried one by one.
TEST(Statistics, TheRankTestAgreesWithTryingAll) {
  const std::vector<double> values = {3, 1, 4, 1, 5, 9, 2, 6, 5, 3};
  const auto wins = [&](unsigned chosen) {  // Mann and Whitney's U, twice
    int u = 0;
    for (unsigned i = 0; i < 10; ++i)
      for (unsigned j = 0; j < 10; ++j)
        if ((chosen >> i & 1) && !(chosen >> j & 1)) u += values[i] > values[j] ? 2 : values[i] == values[j] ? 1 : 0;
    return u;
  };
  const unsigned observed = 0b1010100101;
  ASSERT_EQ(__builtin_popcount(observed), 5);
  int all = 0, far = 0;
  for (unsigned chosen = 0; chosen < 1024; ++chosen) {
    if (__builtin_popcount(chosen) != 5) continue;
    ++all, far += std::abs(wins(chosen) - 25) >= std::abs(wins(observed) - 25);
  }
  std::vector<double> a, b;
  for (unsigned i = 0; i < 10; ++i) (observed >> i & 1 ? a : b).push_back(values[i]);
  EXPECT_DOUBLE_EQ(rank_test(a, b), static_cast<double>(far) / all);
}

// Four tests: 0.005 x 4 = 0.02, 0.01 x 3 = 0.03, 0.03 x 2 = 0.06, 0.04 x 1 = 0.04, which may not be below 0.06.
TEST(Statistics, HolmsCorrectionIsThatWorkedOutByHand) {
  const std::vector<double> corrected = holm(std::vector{0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  ASSERT_EQ(corrected.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(corrected[i], expected[i]) << i;
  EXPECT_EQ(holm(std::vector{0.04}), (std::vector{0.04})) << "one test needs none";
  EXPECT_EQ(holm(std::vector{0.5, 0.75}), (std::vector{1.0, 1.0}));
  EXPECT_EQ(holm(std::vector{0.25, 0.25}), (std::vector{0.5, 0.5}));
  EXPECT_TRUE(holm({}).empty());
  // Five variants of five seeds, all apart from the first as far as can be: 4 x 2/252.
  for (const double chance : holm(std::vector(4, least_rank_test(5, 5)))) EXPECT_DOUBLE_EQ(chance, 8.0 / 252);
}

TEST(Statistics, LargeSamplesAreNearTheExactTest) {
  std::vector<double> a, b;
  for (int i = 0; i < 25; ++i) a.push_back(i), b.push_back(i + 7.5);
  const double exact = rank_test(a, b);
  a.push_back(12), b.push_back(19.5);
  EXPECT_NEAR(rank_test(a, b), exact, 0.01);
  EXPECT_LT(exact, 0.05);
}

}  // namespace
}  // namespace espalier
