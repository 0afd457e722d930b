#include "breed/taste.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kFeatures = 8;

std::vector<double> point(RandomStream& random) {
  std::vector<double> features(kFeatures);
  for (double& f : features) f = random.next_unit();
  return features;
}

double linear(const std::vector<double>& f) { return 2 * f[1] - f[4]; }
double quadratic(const std::vector<double>& f) {
  return -4 * (f[0] - 0.3) * (f[0] - 0.3) - 4 * (f[2] - 0.8) * (f[2] - 0.8) + f[5];
}

std::vector<Opinion> opinions_of(const std::function<double(const std::vector<double>&)>& taste, std::size_t count,
                                 std::uint32_t seed) {
  RandomStream random({seed, Purpose::test, 0, 0, 0});
  std::vector<Opinion> opinions;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> features = point(random);
    opinions.push_back({features, taste(features) + 0.2 * (random.next_unit() - 0.5)});
  }
  return opinions;
}

double nearest_rating(const std::vector<Opinion>& opinions, const std::vector<double>& at) {
  double best = 1e9, rating = 0;
  for (const Opinion& opinion : opinions) {
    double d = 0;
    for (std::size_t f = 0; f < kFeatures; ++f) d += (opinion.features[f] - at[f]) * (opinion.features[f] - at[f]);
    if (d < best) best = d, rating = opinion.rating;
  }
  return rating;
}

/// Share of held-out pairs that are put in the right order: by the model, and by the nearest neighbour.
std::pair<double, double> order_rates(const std::function<double(const std::vector<double>&)>& taste, std::size_t count) {
  int right = 0, neighbour = 0, pairs = 0;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const std::vector<Opinion> opinions = opinions_of(taste, count, seed);
    const Taste model(opinions, {}, {});
    RandomStream random({seed, Purpose::test, 1, 0, 0});
    for (int i = 0; i < 100; ++i) {
      const std::vector<double> a = point(random), b = point(random);
      const bool truth = taste(a) > taste(b);
      right += truth == (model.forecast(a).rating > model.forecast(b).rating);
      neighbour += truth == (nearest_rating(opinions, a) > nearest_rating(opinions, b));
      ++pairs;
    }
  }
  return {double(right) / pairs, double(neighbour) / pairs};
}

TEST(Taste, LearnsWhatIsLikedBetterThanChanceAndThanTheNearestNeighbour) {
  const auto [straight, straight_neighbour] = order_rates(linear, 40);
  EXPECT_GT(straight, 0.85);
  EXPECT_GT(straight, straight_neighbour + 0.1);
  const auto [bent, bent_neighbour] = order_rates(quadratic, 80);
  EXPECT_GT(bent, 0.75);
  EXPECT_GT(bent, bent_neighbour + 0.05);
}

TEST(Taste, LearnsFromComparisonsAlone) {
  RandomStream random({1, Purpose::test, 2, 0, 0});
  std::vector<Comparison> comparisons;
  for (int i = 0; i < 40; ++i) {
    const std::vector<double> a = point(random), b = point(random);
    comparisons.push_back(linear(a) > linear(b) ? Comparison{a, b} : Comparison{b, a});
  }
  const Taste model({}, comparisons, {});
  EXPECT_EQ(model.opinions(), 40u);
  int right = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<double> a = point(random), b = point(random);
    right += (linear(a) > linear(b)) == (model.forecast(a).rating > model.forecast(b).rating);
  }
  EXPECT_GT(right, 310);
}

TEST(Taste, DoubtGrowsAwayFromWhatWasRated) {
  const std::vector<Opinion> opinions = opinions_of(linear, 30, 3);
  const Taste model(opinions, {}, {});
  std::vector<double> middle(kFeatures, 0.5);
  double last = 0;
  for (const double away : {0.5, 1., 2., 4.}) {
    std::vector<double> far = middle;
    far[0] += away;
    EXPECT_GT(model.forecast(far).deviation, last);
    last = model.forecast(far).deviation;
  }
  EXPECT_LT(model.forecast(opinions[0].features).deviation, model.forecast(std::vector<double>(kFeatures, 3)).deviation);
}

TEST(Taste, TheOrderOfOpinionsDoesNotCount) {
  std::vector<Opinion> opinions = opinions_of(quadratic, 50, 4);
  const Taste one(opinions, {}, {});
  std::reverse(opinions.begin(), opinions.end());
  std::swap(opinions[3], opinions[20]);
  const Taste two(opinions, {}, {});
  RandomStream random({9, Purpose::test, 3, 0, 0});
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> at = point(random);
    EXPECT_EQ(one.forecast(at).rating, two.forecast(at).rating);
    EXPECT_EQ(one.forecast(at).deviation, two.forecast(at).deviation);
  }
}

TEST(Taste, SaysWhy) {
  const Taste model(opinions_of(linear, 60, 5), {}, {});
  const std::vector<std::string> names = {"a", "height", "c", "d", "taper", "f", "g", "h"};
  std::vector<double> liked(kFeatures, 0.5);
  liked[1] = 1, liked[4] = 0.9;
  EXPECT_THAT(model.reasons(liked, names, 1), HasSubstr("you like: more height"));
  EXPECT_THAT(model.reasons(liked, names, 1), HasSubstr("you dislike: more taper"));
  const std::vector<double> gains = model.contributions(liked);
  EXPECT_GT(gains[1], 0.3);
  EXPECT_LT(gains[4], -0.1);
}

TEST(Taste, EqualRatingsAndEqualFeaturesAreNoTrouble) {
  std::vector<Opinion> same(5, {std::vector<double>(3, 0.5), 2});
  const Taste model(same, {}, {});
  EXPECT_NEAR(model.forecast({0.5, 0.5, 0.5}).rating, 2, 1e-9);
  EXPECT_TRUE(std::isfinite(model.forecast({9, 0, 0}).deviation));
}

TEST(Taste, RefusesWhatItCannotLearnFrom) {
  const auto error_of = [](const std::vector<Opinion>& opinions, const TasteSettings& settings = {}) -> std::string {
    try {
      Taste(opinions, {}, settings);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(error_of({}), HasSubstr("at least one opinion"));
  EXPECT_THAT(error_of({{{}, 1}}), HasSubstr("needs features"));
  EXPECT_THAT(error_of({{{1, 2}, 1}, {{1}, 1}}), HasSubstr("must have 2 features each, got 1"));
  EXPECT_THAT(error_of({{{NAN}, 1}}), HasSubstr("finite"));
  EXPECT_THAT(error_of({{{1}, 1}}, {.noise = 0}), HasSubstr("noise must be above 0"));
}

}  // namespace
}  // namespace espalier
