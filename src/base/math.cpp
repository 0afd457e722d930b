#include "base/math.h"

#include "base/natural_exp.h"
#include "base/natural_log.h"

namespace espalier {
namespace {

double central(double q) {
  const double r = q * q;
  const double numerator = ((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
                             1.383577518672690e+02) * r - 3.066479806614716e+01) * r + 2.506628277459239e+00;
  const double denominator = ((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
                               6.680131188771972e+01) * r - 1.328068155288572e+01) * r + 1;
  return numerator * q / denominator;
}

double tail(double p) {
  const double q = std::sqrt(-2.0 * static_cast<double>(std::log(static_cast<float>(p))));
  const double numerator = ((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838e+00) * q -
                             2.549732539343734e+00) * q + 4.374664141464968e+00) * q + 2.938163982698783e+00;
  const double denominator = (((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996e+00) * q +
                              3.754408661907416e+00) * q + 1;
  return numerator / denominator;
}

/// Rounded to float, of any x; what is too large or too small is infinity or 0.
float rounded_exponential(double x) {
  if (x != x) return NAN;
  if (x > 89) return INFINITY;
  return x < -104 ? 0.0f : static_cast<float>(natural_exp(x));
}

bool is_whole(float x) { return std::floor(x) == x; }
bool is_odd(float x) { return is_whole(x) && std::floor(x / 2) != x / 2; }

}  // namespace

float exponential(float x) { return rounded_exponential(x); }

float power(float base, float exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (base != base || exponent != exponent) return NAN;
  if (std::isinf(exponent)) {
    const float size = std::fabs(base);
    return size == 1 ? 1 : (size > 1) == (exponent > 0) ? INFINITY : 0;
  }
  if (base < 0 && !std::isinf(base) && !is_whole(exponent)) return NAN;
  const float sign = std::signbit(base) && is_odd(exponent) ? -1.0f : 1.0f;
  if (base == 0 || std::isinf(base)) return sign * ((base == 0) == (exponent < 0) ? INFINITY : 0.0f);
  return sign * rounded_exponential(exponent * natural_log(std::fabs(static_cast<double>(base))));
}

float inverse_normal_cdf(double p) {
  constexpr double kTail = 0.02425;
  if (p < kTail) return static_cast<float>(tail(p));
  if (p > 1 - kTail) return static_cast<float>(-tail(1 - p));
  return static_cast<float>(central(p - 0.5));
}

double normal_cdf(float x) { return 0.5 * static_cast<double>(std::erfc(-x * 0.70710678f)); }

}  // namespace espalier
