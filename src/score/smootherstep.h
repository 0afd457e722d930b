#pragma once
// The normalising step of the 2016 score: 0 up to `from`, 1 from `to` on, a quintic with flat ends between.
// (Haubenwallner et al. 2016, eq. 6; Perlin's smootherstep.)

namespace espalier {

/// S(x, from, to) = 6 t^5 - 15 t^4 + 10 t^3 with t = (x - from) / (to - from), clamped to [0, 1]. Where from >= to it
/// is a step: 0 for x <= from, else 1. Uses + - * / only, so every machine gives the same bits.
inline double smootherstep(double x, double from, double to) {
  if (!(x > from)) return 0;
  if (x >= to) return 1;
  const double t = (x - from) / (to - from);
  return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace espalier
