#pragma once
// log x in double precision from + - * / alone, so that priors have the same bits on every CPU (glibc's double
// functions take other code paths where the CPU has fused multiply-add).

#include <bit>
#include <cstdint>
#include <limits>

namespace espalier {

/// Natural logarithm of a normal x > 0, within 2 ulp; -infinity for x <= 0 and for subnormal x.
inline double natural_log(double x) {
  constexpr double kSmallest = std::numeric_limits<double>::min();
  if (!(x >= kSmallest)) return x != x ? x : -std::numeric_limits<double>::infinity();
  if (x > std::numeric_limits<double>::max()) return x;
  // x = 2^exponent * m, sqrt(1/2) <= m < sqrt(2)
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffu) | 0x3ff0000000000000u);
  if (m > 1.4142135623730951) m *= 0.5, ++exponent;
  // log m = 2 artanh s = 2 s (1 + s^2/3 + s^4/5 + ...), |s| < 0.1716: terms up to s^22 reach 2^-58
  const double s = (m - 1) / (m + 1), s2 = s * s;
  double series = 0;
  for (int k = 23; k >= 3; k -= 2) series = s2 * (1.0 / k + series);
  constexpr double kLog2High = 0x1.62e42fefa0000p-1, kLog2Low = 0x1.cf79abc9e3b3ap-40;
  return exponent * kLog2High + (2 * s + (2 * s * series + exponent * kLog2Low));
}

}  // namespace espalier
