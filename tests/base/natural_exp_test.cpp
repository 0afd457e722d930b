#include "base/natural_exp.h"

#include <gtest/gtest.h>

#include "base/natural_log.h"
#include "base/random.h"

namespace espalier {
namespace {

TEST(NaturalExp, IsWithinFourUlp) {
  RandomStream random({1, Purpose::test});
  for (int i = 0; i < 200000; ++i) {
    const double x = (random.next_unit() - 0.5) * (i % 2 ? 1410 : 4);
    const double expected = static_cast<double>(std::exp(static_cast<long double>(x)));
    const double ulp = std::nextafter(expected, 1e308) - expected;
    ASSERT_LE(std::abs(natural_exp(x) - expected), 4 * ulp) << x;
  }
}

TEST(NaturalExp, KnowsItsEdges) {
  EXPECT_EQ(natural_exp(0), 1);
  EXPECT_EQ(natural_exp(-INFINITY), 0);
  EXPECT_EQ(natural_exp(-709), 0);
  EXPECT_GT(natural_exp(-708), 0);
  EXPECT_EQ(natural_exp(INFINITY), INFINITY);
  EXPECT_EQ(natural_exp(710), INFINITY);
  EXPECT_LT(natural_exp(709), INFINITY);
  EXPECT_TRUE(std::isnan(natural_exp(NAN)));
}

TEST(NaturalExp, UndoesTheLogarithm) {
  for (double x = 1e-300; x < 1e300; x *= 7) EXPECT_NEAR(natural_exp(natural_log(x)) / x, 1, 1e-12) << x;
}

}  // namespace
}  // namespace espalier
