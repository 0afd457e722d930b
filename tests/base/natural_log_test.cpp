#include "base/natural_log.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace espalier {
namespace {

TEST(NaturalLog, IsWithinTwoUlp) {
  RandomStream random({1, Purpose::test});
  for (int i = 0; i < 200000; ++i) {
    const double mantissa = 1 + random.next_unit();
    const double x = i % 2 ? std::ldexp(mantissa, static_cast<int>(random.below(2000)) - 1000)
                           : 0.5 + 1.5 * random.next_unit();
    const double expected = static_cast<double>(std::log(static_cast<long double>(x)));
    const double ulp = std::nextafter(std::abs(expected), 1e300) - std::abs(expected);
    ASSERT_LE(std::abs(natural_log(x) - expected), 2 * ulp) << x;
  }
}

TEST(NaturalLog, KnowsItsEdges) {
  EXPECT_EQ(natural_log(1), 0);
  EXPECT_EQ(natural_log(0), -INFINITY);
  EXPECT_EQ(natural_log(-1), -INFINITY);
  EXPECT_EQ(natural_log(INFINITY), INFINITY);
  EXPECT_TRUE(std::isnan(natural_log(NAN)));
}

}  // namespace
}  // namespace espalier
