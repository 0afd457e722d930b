#pragma once
// e^x in double precision from + - * / alone, so that weights have the same bits on every CPU (as base/natural_log.h).

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace espalier {

/// e^x within about 4 ulp; 0 below -708, infinity above 709, NaN for NaN.
inline double natural_exp(double x) {
  if (x != x) return x;
  if (x > 709) return std::numeric_limits<double>::infinity();
  if (x < -708) return 0;
  // x = k log 2 + r, |r| <= 0.3466: the Taylor series up to r^13 leaves less than 2^-55
  constexpr double kLog2High = 0x1.62e42fefa0000p-1, kLog2Low = 0x1.cf79abc9e3b3ap-40;
  const double k = std::floor(x / (kLog2High + kLog2Low) + 0.5);
  const double r = (x - k * kLog2High) - k * kLog2Low;
  constexpr double kInverse[] = {0,       1,       1. / 2, 1. / 3, 1. / 4,  1. / 5,  1. / 6,
                                 1. / 7, 1. / 8, 1. / 9, 1. / 10, 1. / 11, 1. / 12, 1. / 13};
  double series = 1;
  for (std::size_t n = 13; n >= 1; --n) series = 1 + r * kInverse[n] * series;
  return series * std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1023) << 52);
}

}  // namespace espalier
