#include "model/circle.h"

#include "base/math.h"

namespace espalier {

// By the Taylor series on one octant, mirrored into the others: libm's double sine has not the same bits everywhere.
CirclePoint circle_point(std::uint32_t i, std::uint32_t n) {
  const std::uint32_t eighths = 8 * i / n;
  const bool flipped = eighths % 2 == 1;  // odd octants are measured back from their end
  const std::uint32_t numerator = flipped ? n * (eighths + 1) - 8 * i : 8 * i - n * eighths;
  const double x = 2 * kPi * numerator / (8.0 * n), x2 = x * x;
  double sine = 0, cosine = 0;
  for (int k = 9; k >= 0; --k) {
    cosine = 1 - (k == 9 ? 0 : cosine) * x2 / ((2 * k + 1) * (2 * k + 2));
    sine = 1 - (k == 9 ? 0 : sine) * x2 / ((2 * k + 2) * (2 * k + 3));
  }
  sine *= x;
  switch (eighths % 8) {
    case 0: return {cosine, sine};
    case 1: return {sine, cosine};
    case 2: return {-sine, cosine};
    case 3: return {-cosine, sine};
    case 4: return {-cosine, -sine};
    case 5: return {-sine, -cosine};
    case 6: return {sine, -cosine};
    default: return {cosine, -sine};
  }
}

}  // namespace espalier
