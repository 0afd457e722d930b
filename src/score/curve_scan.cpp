#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_AVX3 | HWY_AVX3_DL)  // see volume_kernel.cpp
#define HWY_COMPILE_ALL_ATTAINABLE

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "score/curve_scan.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "score/curve_scan.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 8>;
using Row = hn::Vec<Floats>;

/// Of the chords: squared distances, and where along the chord the nearest point is, 0..1.
struct alignas(32) ChordScan {
  float distance2[CurveTable::kChords], at[CurveTable::kChords];
};

/// The least of the squared distances.
float scan_chords(const CurveTable& curve, const float p[3], ChordScan& out) {
  const Floats f;
  Row least = hn::Set(f, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < CurveTable::kChords; i += hn::Lanes(f)) {
    Row away[3], dot = hn::Zero(f);
    for (int a = 0; a < 3; ++a) {
      away[a] = hn::Sub(hn::Set(f, p[a]), hn::Load(f, curve.from[a] + i));
      dot = hn::Add(dot, hn::Mul(away[a], hn::Load(f, curve.along[a] + i)));
    }
    const Row s = hn::Min(hn::Max(hn::Mul(dot, hn::Load(f, curve.per_length2 + i)), hn::Zero(f)), hn::Set(f, 1.0f));
    Row distance2 = hn::Zero(f);
    for (int a = 0; a < 3; ++a) {
      const Row rest = hn::Sub(away[a], hn::Mul(s, hn::Load(f, curve.along[a] + i)));
      distance2 = hn::Add(distance2, hn::Mul(rest, rest));
    }
    hn::Store(distance2, f, out.distance2 + i);
    hn::Store(s, f, out.at + i);
    least = hn::Min(least, distance2);
  }
  return hn::GetLane(hn::MinOfLanes(f, least));
}

/// A point or a direction; the fourth lane is 0.
using Xyz = float __attribute__((vector_size(16)));

Xyz load(const float v[3]) { return Xyz{v[0], v[1], v[2], 0}; }

float dot(Xyz a, Xyz b) {
  const Xyz product = a * b;
  return product[0] + product[1] + product[2];
}

/// Newton's method from t.
void refine_from(const Xyz power[4], Xyz p, float t, CurveHit& best) {
  Xyz away = power[0] - p + t * (power[1] + t * (power[2] + t * power[3]));
  CurveHit found{t, dot(away, away)};
  for (int turn = 0; turn < 8; ++turn) {  // half as many leave errors of 0.01 here and there
    const Xyz square = power[2] + power[2], cubic = 3.0f * t * power[3];
    const Xyz first = power[1] + t * (square + cubic), second = square + cubic + cubic;
    const float slope = dot(away, first), speed2 = dot(first, first), bend = speed2 + dot(away, second);
    if (!(speed2 > 0)) break;
    // Where the distance is no valley, a step of Gauss and Newton still leads down.
    const float step = slope / (bend > 0.1f * speed2 ? bend : speed2);
    const float next = std::min(std::max(t - step, 0.0f), 1.0f);
    const float moved = std::abs(next - t);
    if (moved == 0) break;
    t = next;
    away = power[0] - p + t * (power[1] + t * (power[2] + t * power[3]));
    const float distance2 = dot(away, away);
    // Of what is equally far but for rounding, the later one: distances tell t to no better than the root of that.
    if (distance2 < 1.000001f * found.distance2) found = {t, distance2};
    if (moved < 1e-5f) break;
  }
  if (found.distance2 < best.distance2) best = found;
}

/// From each chord whose nearest point may be the nearest of all (distance2 <= reach2), but once in each valley.
CurveHit refine(const CurveTable& curve, const float p[3], const ChordScan& scan, float reach2) {
  CurveHit best{0, std::numeric_limits<float>::infinity()};
  const Xyz power[4] = {load(curve.power[0]), load(curve.power[1]), load(curve.power[2]), load(curve.power[3])};
  for (std::size_t i = 0; i < CurveTable::kChords; ++i) {
    const float here = scan.distance2[i];
    if (here > reach2 || (i > 0 && scan.distance2[i - 1] <= here)) continue;
    if (i + 1 < CurveTable::kChords && scan.distance2[i + 1] < here) continue;
    refine_from(power, load(p), (static_cast<float>(i) + scan.at[i]) * (1.0f / CurveTable::kChords), best);
  }
  return best;
}

void scan(const CurveTable* curves, std::size_t count, const float p[3], CurveHit* hits) {
  constexpr std::size_t kAtOnce = 64;
  ChordScan scans[kAtOnce];
  float least[kAtOnce];
  float nearest = std::numeric_limits<float>::infinity(), smallest = nearest;
  for (std::size_t c = 0; c < count; ++c) {
    least[c] = scan_chords(curves[c], p, scans[c]);
    smallest = std::min(smallest, least[c]);
    nearest = std::min(nearest, std::sqrt(least[c]) + curves[c].gap);
  }
  for (std::size_t c = 0; c < count; ++c) {
    const float reach = nearest + curves[c].gap;
    const float reach2 = std::max(reach * reach, smallest);  // far away a small gap is lost in rounding
    hits[c] = least[c] <= reach2 ? refine(curves[c], p, scans[c], reach2)
                                 : CurveHit{0, std::numeric_limits<float>::infinity()};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace espalier {

HWY_EXPORT(scan);

void scan_curves(const CurveTable* curves, std::size_t count, const float p[3], CurveHit* hits) {
  HWY_DYNAMIC_DISPATCH(scan)(curves, count, p, hits);
}

}  // namespace espalier

#endif  // HWY_ONCE
