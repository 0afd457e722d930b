#pragma once
// Elementary functions whose bits do not depend on the CPU. glibc's double functions, and of its float functions exp
// and pow, take other code paths where the CPU has fused multiply-add. These use only IEEE + - * / and sqrt, and those
// float functions that do not: log, asin, acos, atan, atan2 and erfc (over all floats the same with and without, glibc
// 2.36).

#include <bit>
#include <cmath>
#include <cstdint>

namespace espalier {

inline constexpr double kPi = 3.14159265358979323846;

/// Sine and cosine of x radians, within 1 ulp of float for |x| < 1e6; NaN when x is not finite or |x| >= 2^30.
inline void sin_cos(float x, float& sine, float& cosine) {
  if (!(x > -1073741824.0f && x < 1073741824.0f)) {
    sine = cosine = NAN;
    return;
  }
  const double scaled = x * (2 / kPi);
  const int quarter = static_cast<int>(scaled + std::copysign(0.5, scaled));
  const double r = x - quarter * (kPi / 2);  // |r| <= pi/4; exact enough: quarter has at most 30 bits
  const double r2 = r * r;
  // Taylor series, whose remainder is below 2e-9 on this range: of sin(r) / r and of cos(r) side by side.
  using Two = double __attribute__((vector_size(16)));
  const Two square = {r2, r2};
  Two sum = Two{0, -1.0 / 3628800};
  sum = Two{1.0 / 362880, 1.0 / 40320} + square * sum;
  sum = Two{-1.0 / 5040, -1.0 / 720} + square * sum;
  sum = Two{1.0 / 120, 1.0 / 24} + square * sum;
  sum = Two{-1.0 / 6, -0.5} + square * sum;
  sum = Two{1, 1} + square * sum;
  // Which is which, and the signs, without branches: the quarters of random angles cannot be foretold.
  const float both[2] = {static_cast<float>(r * sum[0]), static_cast<float>(sum[1])};
  const auto with_sign = [](float value, int turned) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ static_cast<std::uint32_t>(turned & 2) << 30);
  };
  sine = with_sign(both[quarter & 1], quarter);
  cosine = with_sign(both[~quarter & 1], quarter + 1);
}

inline float sine(float x) {
  float s, c;
  sin_cos(x, s, c);
  return s;
}
inline float cosine(float x) {
  float s, c;
  sin_cos(x, s, c);
  return c;
}
inline float tangent(float x) {
  float s, c;
  sin_cos(x, s, c);
  return s / c;
}

/// e^x, correctly rounded but for about one x in a million.
float exponential(float x);
/// base^exponent, as exact; special values as those of C's pow.
float power(float base, float exponent);

/// The x for which a standard normal variable is below x with probability p, 0 < p < 1 (Acklam's rational
/// approximation, relative error below 1.2e-9 before rounding of the logarithm).
float inverse_normal_cdf(double p);

/// The probability that a standard normal variable is below x.
double normal_cdf(float x);

}  // namespace espalier
