#include "score/weight_image.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"

namespace espalier {
namespace {

TEST(WeightImage, DarkIsWantedLightIsNotGreyAndClearDoNotMatter) {
  const WeightImage image = weights_from_light(5, 1, {0, 1, 0.5f, 0, 0.25f}, {1, 1, 1, 0, 0.5f});
  EXPECT_EQ(image.degrees, (std::vector<std::int32_t>{65535, -65535, 0, 0, 16384}));
}

TEST(WeightImage, ReducedPixelsAreMeansByArea) {
  const WeightImage image{4, 2, {8, 0, 0, -8, 8, 8, 0, 0}};
  EXPECT_EQ(resized(image, 2, 1).degrees, (std::vector<std::int32_t>{6, -2}));
  EXPECT_EQ(resized(image, 4, 2).degrees, image.degrees);
  EXPECT_EQ(resized({3, 1, {30, 60, 90}}, 2, 1).degrees, (std::vector<std::int32_t>{40, 80})) << "1 1/2 pixels each";
  EXPECT_EQ(resized({1, 1, {7}}, 3, 2).degrees, (std::vector<std::int32_t>(6, 7)));
  EXPECT_THROW(resized(image, 0, 1), Error);
  EXPECT_THROW(resized(image, 1, 100'000), Error);
}

TEST(WeightImage, TheMeanStaysWhatItIs) {
  RandomStream random({1, Purpose::test});
  for (int i = 0; i < 50; ++i) {
    WeightImage image{2 + random.below(30), 2 + random.below(30), {}};
    double mean = 0;
    for (std::size_t k = 0; k < std::size_t{image.width} * image.height; ++k) {
      image.degrees.push_back(static_cast<std::int32_t>(random.below(131071)) - 65535);
      mean += image.degrees.back();
    }
    const WeightImage small = resized(image, 1 + random.below(image.width), 1 + random.below(image.height));
    double other = 0;
    for (const std::int32_t degree : small.degrees) other += degree;
    EXPECT_NEAR(other / static_cast<double>(small.degrees.size()), mean / static_cast<double>(image.degrees.size()),
                0.51);
  }
}

}  // namespace
}  // namespace espalier
