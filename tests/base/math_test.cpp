#include "base/math.h"

#include <cmath>

#include <gtest/gtest.h>

namespace espalier {
namespace {

TEST(SinCos, AgreesWithTheLibrary) {
  for (int i = -200'000; i <= 200'000; ++i) {
    const float x = static_cast<float>(i) * 0.001f;
    float s, c;
    sin_cos(x, s, c);
    ASSERT_NEAR(s, std::sin(static_cast<double>(x)), 1e-7) << x;
    ASSERT_NEAR(c, std::cos(static_cast<double>(x)), 1e-7) << x;
  }
}

TEST(SinCos, IsNotANumberWhereItHasNoMeaning) {
  for (const float x : {INFINITY, -INFINITY, NAN, 3e9f}) {
    EXPECT_TRUE(std::isnan(sine(x)));
    EXPECT_TRUE(std::isnan(cosine(x)));
  }
}

TEST(InverseNormal, UndoesTheDistribution) {
  for (double p = 0.001; p < 1; p += 0.001) EXPECT_NEAR(normal_cdf(inverse_normal_cdf(p)), p, 2e-6);
}

}  // namespace
}  // namespace espalier
