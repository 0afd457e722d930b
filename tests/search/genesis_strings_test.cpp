#include "search/genesis_strings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "derivation/chi_square.h"

namespace espalier {
namespace {

RandomStream stream(std::uint32_t i) { return RandomStream({1, Purpose::test, 3, i, 0}); }

BitString random_string(std::size_t bits, RandomStream& random) {
  BitString string(bits);
  for (std::uint8_t& bit : string) bit = random.next_u32() & 1;
  return string;
}

TEST(GenesisStrings, EverybodyGetsTheFloorOrTheCeilingOfWhatIsExpected) {
  for (std::uint32_t i = 0; i < 300; ++i) {
    RandomStream random = stream(i);
    std::vector<double> values(2 + random.below(30));
    for (double& value : values) value = 10 * random.next_unit() - 5;
    const double worst = *std::min_element(values.begin(), values.end());
    GenesisSettings settings;
    settings.selection = i % 2 ? GenesisSelection::ranking : GenesisSelection::proportional;
    const auto n = static_cast<std::uint32_t>(values.size());
    const std::vector<double> expected = expected_places(values, worst - (i % 3), settings);
    EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), n, 1e-9);
    std::vector<double> got(n);
    for (const std::uint32_t place : sample_universally(expected, n, random)) got[place] += 1;
    for (std::uint32_t k = 0; k < n; ++k) {
      EXPECT_GE(got[k], std::floor(expected[k] - 1e-9));
      EXPECT_LE(got[k], std::ceil(expected[k] + 1e-9));
    }
  }
}

TEST(GenesisStrings, SamplingIsFairOnAverage) {
  const std::vector<double> expected = {0.3, 1.45, 0.25, 2, 0};
  std::vector<int> got(5);
  constexpr int kRounds = 20'000;
  for (int i = 0; i < kRounds; ++i) {
    RandomStream random = stream(static_cast<std::uint32_t>(i));
    for (const std::uint32_t place : sample_universally(expected, 4, random)) ++got[place];
  }
  // Of one round each count has a variance of at most 1/4.
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(got[k] / double{kRounds}, expected[k], 4 * 0.5 / std::sqrt(kRounds));
}

TEST(GenesisStrings, EqualValuesAreSelectedAlikeAndNegativeOnesAreFine) {
  GenesisSettings settings;
  for (const GenesisSelection selection : {GenesisSelection::proportional, GenesisSelection::ranking}) {
    settings.selection = selection;
    EXPECT_THAT(expected_places(std::vector<double>{0, 0, 0}, -7, settings), ::testing::Each(1.0));
    EXPECT_THAT(expected_places(std::vector<double>{-4, -4}, -4, settings), ::testing::Each(1.0));
  }
  settings.selection = GenesisSelection::proportional;
  EXPECT_THAT(expected_places(std::vector<double>{-3, -1, -2, -2}, -3, settings), ::testing::ElementsAre(0, 2, 1, 1));
  EXPECT_THAT(expected_places(std::vector<double>{-3, -1}, -5, settings), ::testing::ElementsAre(2 / 3., 4 / 3.));
  settings.selection = GenesisSelection::ranking;
  EXPECT_THAT(expected_places(std::vector<double>{-3, 100, 5}, -3, settings), ::testing::ElementsAre(0.75, 1.25, 1));
}

TEST(GenesisStrings, ABitDrawnAnewFlipsHalfTheTime) {
  std::vector<int> flips(2);
  RandomStream random = stream(0);
  BitString string = random_string(1, random);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint8_t before = string[0];
    mutate_bits(string, 1, {}, random);
    ++flips[string[0] != before];
  }
  test::expect_distribution({0.5, 0.5}, flips);

  // And at the rate of the settings.
  std::vector<int> changed(2);
  BitString many(1000);
  for (int i = 0; i < 300; ++i) {
    const BitString before = many;
    mutate_bits(many, 0.1, {}, random);
    for (std::size_t k = 0; k < many.size(); ++k) ++changed[many[k] != before[k]];
  }
  test::expect_distribution({0.95, 0.05}, changed);
}

TEST(GenesisStrings, CrossoverKeepsTheBitsOfEveryPlaceAndChangesOneRun) {
  int crossed = 0;
  for (std::uint32_t i = 0; i < 500; ++i) {
    RandomStream random = stream(i);
    BitString a(40, 0), b(40, 1);
    crossed += cross_at_two_points(a, b, {}, random);
    int borders = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k] + b[k], 1);
      borders += k > 0 && a[k] != a[k - 1];
    }
    EXPECT_LE(borders, 2);
  }
  EXPECT_GT(crossed, 450);
}

TEST(GenesisStrings, HeldBitsNeitherMutateNorCross) {
  BitString held(30);
  std::fill_n(held.begin() + 10, 10, 1);
  for (std::uint32_t i = 0; i < 200; ++i) {
    RandomStream random = stream(i);
    BitString a = random_string(30, random), b = random_string(30, random);
    const BitString a0 = a, b0 = b;
    cross_at_two_points(a, b, held, random);
    mutate_bits(a, 0.5, held, random);
    for (std::size_t k = 10; k < 20; ++k) {
      EXPECT_EQ(a[k], a0[k]);
      EXPECT_EQ(b[k], b0[k]);
    }
  }
}

TEST(GenesisStrings, TheEliteIsNeverLost) {
  for (std::uint32_t i = 0; i < 400; ++i) {
    RandomStream random = stream(i);
    GenesisSettings settings;
    settings.mutation = 0.2;
    settings.gap = i % 4 == 0 ? 0.3 : 1;
    settings.selection = i % 2 ? GenesisSelection::ranking : GenesisSelection::proportional;
    std::vector<BitString> strings;
    std::vector<double> values;
    for (int k = 0; k < 9; ++k) {
      strings.push_back(random_string(20, random));
      values.push_back(random.next_unit());
    }
    const auto best = std::max_element(values.begin(), values.end()) - values.begin();
    const double worst = *std::min_element(values.begin(), values.end());
    const std::uint32_t count = 5 + i % 9;
    const auto children = next_strings(strings, values, count, worst, settings, {}, random);
    ASSERT_EQ(children.size(), count);
    int elites = 0;
    for (const GenesisChild& child : children) {
      elites += child.string == strings[static_cast<std::size_t>(best)] && !child.changed;
      EXPECT_EQ(child.changed, child.string != strings[child.parent]);
    }
    EXPECT_GE(elites, 1);
  }
}

TEST(GenesisStrings, TheGenerationGapCarriesTheRestOver) {
  RandomStream random = stream(7);
  std::vector<BitString> strings;
  for (int k = 0; k < 10; ++k) strings.push_back(random_string(30, random));
  GenesisSettings settings;
  settings.gap = 0.4;
  settings.mutation = 1;
  settings.elitism = false;
  const auto children = next_strings(strings, std::vector<double>(10, 0), 10, 0, settings, {}, random);
  std::vector<std::uint32_t> kept;
  for (const GenesisChild& child : children) {
    if (!child.changed) kept.push_back(child.parent);
  }
  EXPECT_EQ(kept.size(), 6u);
  std::sort(kept.begin(), kept.end());
  EXPECT_EQ(std::unique(kept.begin(), kept.end()), kept.end()) << "without replacement";
}

TEST(GenesisStrings, TheWindowForgets) {
  ScalingWindow window(2);
  for (const double worst : {-5., 1., 2., 3.}) window.add(worst);
  EXPECT_EQ(window.worst(), 1);
  ScalingWindow now(0);
  now.add(-1), now.add(4);
  EXPECT_EQ(now.worst(), 4);
}

}  // namespace
}  // namespace espalier
