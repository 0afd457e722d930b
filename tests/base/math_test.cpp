#include "base/math.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "base/random.h"

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

// Exact but for rare halves: the nearest float, by long double.
TEST(Exponential, IsTheNearestFloat) {
  int off = 0;
  for (std::uint32_t bits = 0; bits < 0xff80'0000u; bits += 4099) {
    const float x = std::bit_cast<float>(bits);
    if (std::isnan(x)) continue;
    const auto exact = static_cast<float>(std::exp(static_cast<long double>(x)));
    const float got = exponential(x);
    if (got == exact) continue;
    ++off;
    ASSERT_LE(std::fabs(got - exact), 1.001f * (std::nextafter(exact, INFINITY) - exact)) << x;
  }
  EXPECT_LE(off, 5);
  EXPECT_TRUE(std::isnan(exponential(NAN)));
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-INFINITY), 0);
  EXPECT_EQ(exponential(INFINITY), INFINITY);
  EXPECT_EQ(exponential(3e38f), INFINITY);
}

TEST(Power, IsTheNearestFloat) {
  RandomStream random({1, Purpose::test});
  int off = 0;
  for (int i = 0; i < 300'000; ++i) {
    const float base = std::exp(20 * static_cast<float>(random.next_unit()) - 10);
    const float exponent = 8 * static_cast<float>(random.next_unit()) - 4;
    const auto exact =
        static_cast<float>(std::pow(static_cast<long double>(base), static_cast<long double>(exponent)));
    const float got = power(base, exponent);
    if (got == exact) continue;
    ++off;
    ASSERT_LE(std::fabs(got - exact), 1.001f * (std::nextafter(exact, INFINITY) - exact)) << base << " " << exponent;
  }
  EXPECT_LE(off, 3);
  for (int k = -149; k < 128; ++k) EXPECT_EQ(power(2, static_cast<float>(k)), std::ldexp(1.0f, k)) << k;
  for (int k = 0; k < 5; ++k) EXPECT_EQ(power(-3, static_cast<float>(k)), std::pow(-3.0, k)) << k;
}

TEST(Power, HasThePlatformsSpecialValues) {
  const float values[] = {0.0f, -0.0f, 1, -1, 0.5f, -0.5f, 2, -2, 3, -3, 2.5f, 1e38f, -1e38f, 1e-45f, INFINITY,
                          -INFINITY, NAN, 16777216, 16777215};
  for (const float base : values) {
    for (const float exponent : values) {
      const float expected = std::pow(base, exponent), got = power(base, exponent);
      if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(got)) << base << " ^ " << exponent;
        continue;
      }
      EXPECT_EQ(got, expected) << base << " ^ " << exponent;
      EXPECT_EQ(std::signbit(got), std::signbit(expected)) << base << " ^ " << exponent;
    }
  }
}

// What a CPU without fused multiply-add would give, and any other.
TEST(Elementary, GoldenBits) {
  std::uint32_t sum = 0;
  for (int i = -4000; i <= 4000; ++i) {
    const float x = static_cast<float>(i) * 0.0103f;
    sum = sum * 31 + std::bit_cast<std::uint32_t>(exponential(x));
    sum = sum * 31 + std::bit_cast<std::uint32_t>(power(std::fabs(x) + 0.1f, 0.37f * x));
  }
  EXPECT_EQ(sum, 3989372002u);
}

TEST(InverseNormal, UndoesTheDistribution) {
  for (double p = 0.001; p < 1; p += 0.001) EXPECT_NEAR(normal_cdf(inverse_normal_cdf(p)), p, 2e-6);
}

}  // namespace
}  // namespace espalier
