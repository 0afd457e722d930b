#pragma once
// The arithmetic of the language at run time: one function per Arithmetic code, in single precision throughout.

#include <algorithm>

#include "base/math.h"
#include "grammar/program.h"

namespace espalier {

inline float apply_unary(Arithmetic op, float a) {
  switch (op) {
    case Arithmetic::negate: return -a;
    case Arithmetic::logical_not: return a == 0 ? 1.0f : 0.0f;
    case Arithmetic::absolute: return std::fabs(a);
    case Arithmetic::floor: return std::floor(a);
    case Arithmetic::ceil: return std::ceil(a);
    case Arithmetic::round: return std::floor(a + 0.5f);
    case Arithmetic::sqrt: return std::sqrt(a);
    case Arithmetic::exp: return exponential(a);
    case Arithmetic::log: return std::log(a);
    case Arithmetic::sin: return sine(a);
    case Arithmetic::cos: return cosine(a);
    case Arithmetic::tan: return tangent(a);
    case Arithmetic::asin: return std::asin(a);
    case Arithmetic::acos: return std::acos(a);
    case Arithmetic::atan: return std::atan(a);
    default: return NAN;
  }
}

inline float apply_binary(Arithmetic op, float a, float b) {
  switch (op) {
    case Arithmetic::add: return a + b;
    case Arithmetic::subtract: return a - b;
    case Arithmetic::multiply: return a * b;
    case Arithmetic::divide: return a / b;
    case Arithmetic::modulo: return a - b * std::floor(a / b);
    case Arithmetic::power: return power(a, b);
    case Arithmetic::minimum: return std::min(a, b);
    case Arithmetic::maximum: return std::max(a, b);
    case Arithmetic::atan2: return std::atan2(a, b);
    case Arithmetic::less: return a < b;
    case Arithmetic::less_equal: return a <= b;
    case Arithmetic::greater: return a > b;
    case Arithmetic::greater_equal: return a >= b;
    case Arithmetic::equal: return a == b;
    case Arithmetic::not_equal: return a != b;
    case Arithmetic::logical_and: return a != 0 && b != 0;
    case Arithmetic::logical_or: return a != 0 || b != 0;
    default: return NAN;
  }
}

/// select: a ? b : c; clamp a to b..c; mix from a to b by c; smooth: 0 below a, 1 above b, cubic between, at c.
inline float apply_ternary(Arithmetic op, float a, float b, float c) {
  switch (op) {
    case Arithmetic::select: return a != 0 ? b : c;
    case Arithmetic::clamp: return std::min(std::max(a, b), c);
    case Arithmetic::mix: return a + (b - a) * c;
    case Arithmetic::smooth: {
      const float t = std::min(std::max((c - a) / (b - a), 0.0f), 1.0f);
      return t * t * (3 - 2 * t);
    }
    default: return NAN;
  }
}

inline int operand_count(Arithmetic op) {
  if (op < Arithmetic::add) return 1;
  return op < Arithmetic::select ? 2 : 3;
}

}  // namespace espalier
