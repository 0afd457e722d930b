#pragma once
// Elementary functions whose bits do not depend on the CPU. glibc's double functions take other code paths where the CPU
// has fused multiply-add; these use only IEEE + - * / and sqrt, or glibc's float functions, which do not.

#include <cmath>

namespace espalier {

inline constexpr double kPi = 3.14159265358979323846;

/// Sine and cosine of x radians, within 1 ulp of float for |x| < 1e6; NaN when x is not finite or |x| >= 2^30.
inline void sin_cos(float x, float& sine, float& cosine) {
  if (!(x > -1073741824.0f && x < 1073741824.0f)) {
    sine = cosine = NAN;
    return;
  }
  const double scaled = x * (2 / kPi);
  const int quarter = static_cast<int>(scaled + (scaled < 0 ? -0.5 : 0.5));
  const double r = x - quarter * (kPi / 2);  // |r| <= pi/4; exact enough: quarter has at most 30 bits
  const double r2 = r * r;
  // Taylor series, whose remainder is below 2e-9 on this range.
  const double s = r * (1 + r2 * (-1.0 / 6 + r2 * (1.0 / 120 + r2 * (-1.0 / 5040 + r2 * (1.0 / 362880)))));
  const double c =
      1 + r2 * (-0.5 + r2 * (1.0 / 24 + r2 * (-1.0 / 720 + r2 * (1.0 / 40320 + r2 * (-1.0 / 3628800)))));
  const double a = quarter & 1 ? c : s, b = quarter & 1 ? s : c;
  sine = static_cast<float>(quarter & 2 ? -a : a);
  cosine = static_cast<float>((quarter + 1) & 2 ? -b : b);
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

/// The x for which a standard normal variable is below x with probability p, 0 < p < 1 (Acklam's rational
/// approximation, relative error below 1.2e-9 before rounding of the logarithm).
float inverse_normal_cdf(double p);

/// The probability that a standard normal variable is below x.
double normal_cdf(float x);

}  // namespace espalier
