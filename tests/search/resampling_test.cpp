#include "search/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace espalier {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
constexpr Resampling kAll[] = {Resampling::systematic, Resampling::stratified, Resampling::multinomial,
                               Resampling::residual};

std::vector<double> offspring(Resampling scheme, std::span<const double> weights, std::uint32_t count,
                              RandomStream& random) {
  std::vector<std::uint32_t> ancestors;
  resample(scheme, weights, count, random, ancestors);
  EXPECT_EQ(ancestors.size(), count);
  EXPECT_TRUE(std::is_sorted(ancestors.begin(), ancestors.end()));
  std::vector<double> of(weights.size(), 0);
  for (const std::uint32_t a : ancestors) ++of.at(a);
  return of;
}

TEST(Resampling, LogSumsDoNotOverflow) {
  const double big[] = {1000, 1000, kNothing};
  EXPECT_NEAR(log_sum(big), 1000 + std::log(2), 1e-12);
  const double small[] = {-2000, -2001};
  EXPECT_NEAR(log_sum(small), -2000 + std::log1p(std::exp(-1)), 1e-12);
  const double none[] = {kNothing, kNothing};
  EXPECT_EQ(log_sum(none), kNothing);
  EXPECT_EQ(log_sum({}), kNothing);
}

TEST(Resampling, WeightsSumToOne) {
  const double logs[] = {1e6, 1e6 + std::log(3), kNothing};
  std::vector<double> weights;
  ASSERT_TRUE(normalise(logs, weights));
  EXPECT_NEAR(weights[0], 0.25, 1e-9);
  EXPECT_NEAR(weights[1], 0.75, 1e-9);
  EXPECT_EQ(weights[2], 0);
  const double none[] = {kNothing};
  EXPECT_FALSE(normalise(none, weights));
  EXPECT_EQ(weights.size(), 3u);
}

TEST(Resampling, EffectiveSizesLieBetweenOneAndAll) {
  EXPECT_DOUBLE_EQ(effective_size(std::vector{1.0, 0.0, 0.0}), 1);
  EXPECT_DOUBLE_EQ(effective_size(std::vector{0.25, 0.25, 0.25, 0.25}), 4);
  EXPECT_NEAR(effective_size(std::vector{0.5, 0.25, 0.25}), 8.0 / 3, 1e-12);
}

// The mean number of places is n * w for every scheme, and no scheme has more variance than independent draws.
TEST(Resampling, EverySchemeIsUnbiased) {
  const std::vector<double> weights = {0.05, 0, 0.31, 0.14, 0.4, 0.1, 0};
  constexpr std::uint32_t kCount = 13;
  constexpr int kRounds = 20000;
  for (const Resampling scheme : kAll) {
    RandomStream random({3, Purpose::test, 0, static_cast<std::uint32_t>(scheme)});
    std::vector<double> sum(weights.size(), 0), squares(weights.size(), 0);
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<double> of = offspring(scheme, weights, kCount, random);
      for (std::size_t i = 0; i < of.size(); ++i) sum[i] += of[i], squares[i] += of[i] * of[i];
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double mean = sum[i] / kRounds, expected = kCount * weights[i];
      const double independent = kCount * weights[i] * (1 - weights[i]);
      EXPECT_NEAR(mean, expected, 4 * std::sqrt(independent / kRounds)) << name_of(scheme) << ' ' << i;
      EXPECT_LE(squares[i] / kRounds - mean * mean, independent * 1.05) << name_of(scheme) << ' ' << i;
    }
  }
}

TEST(Resampling, SystematicAndResidualKeepWholeShares) {
  const std::vector<double> weights = {0.05, 0, 0.31, 0.14, 0.4, 0.1, 0};
  RandomStream random({4, Purpose::test});
  for (int round = 0; round < 1000; ++round) {
    const std::vector<double> systematic = offspring(Resampling::systematic, weights, 13, random);
    const std::vector<double> residual = offspring(Resampling::residual, weights, 13, random);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      EXPECT_GE(systematic[i], std::floor(13 * weights[i]));
      EXPECT_LE(systematic[i], std::ceil(13 * weights[i]));
      EXPECT_GE(residual[i], std::floor(13 * weights[i]));
    }
  }
}

TEST(Resampling, RoundingGivesNoPlaceToWeightless) {
  // Ten tenths sum to a little less than 1; the last particle has no weight.
  std::vector<double> weights(11, 0.1);
  weights.back() = 0;
  RandomStream random({5, Purpose::test});
  for (const Resampling scheme : kAll) {
    for (int round = 0; round < 2000; ++round) EXPECT_EQ(offspring(scheme, weights, 1000, random).back(), 0);
  }
}

}  // namespace
}  // namespace espalier
