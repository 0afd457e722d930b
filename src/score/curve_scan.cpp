#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)  // see volume_kernel.cpp
#define HWY_COMPILE_ALL_ATTAINABLE

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "score/curve_scan.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "score/curve_scan.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 8>;
using Row = hn::Vec<Floats>;

constexpr std::size_t kSamples = CurveTable::kSamples;
constexpr float kNone = std::numeric_limits<float>::infinity();

/// Squared distances of the samples, with nothing beyond both ends.
struct alignas(32) SampleScan {
  float all[8 + kSamples + 8];
  float* distance2() { return all + 8; }
  const float* distance2() const { return all + 8; }
};

/// The least of the squared distances.
float scan_samples(const CurveTable& curve, const float p[3], SampleScan& out) {
  const Floats f;
  out.all[7] = out.all[8 + kSamples] = kNone;
  Row least = hn::Set(f, kNone);
  for (std::size_t i = 0; i < kSamples; i += hn::Lanes(f)) {
    Row distance2 = hn::Zero(f);
    for (int a = 0; a < 3; ++a) {
      const Row away = hn::Sub(hn::Load(f, curve.sample[a] + i), hn::Set(f, p[a]));
      distance2 = hn::Add(distance2, hn::Mul(away, away));
    }
    hn::Store(distance2, f, out.distance2() + i);
    least = hn::Min(least, distance2);
  }
  return hn::GetLane(hn::MinOfLanes(f, least));
}

/// A point or a direction; the fourth lane is 0.
using Xyz = float __attribute__((vector_size(16)));

Xyz load(const float v[4]) {
  Xyz out;
  std::memcpy(&out, v, sizeof out);
  return out;
}

float dot(Xyz a, Xyz b) {
  const Xyz product = a * b;
  return product[0] + product[1] + product[2];
}

CurveHit hit_at(const CurveTable& curve, Xyz p, float t) {
  const Xyz away =
      load(curve.power[0]) - p + t * (load(curve.power[1]) + t * (load(curve.power[2]) + t * load(curve.power[3])));
  return {t, dot(away, away)};
}

/// Down to the bottom of the valley by Newton's method, wherever it starts: a parameter.
float descend(const CurveTable& curve, Xyz p, float t) {
  const Xyz power[4] = {load(curve.power[0]), load(curve.power[1]), load(curve.power[2]), load(curve.power[3])};
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
  return found.t;
}

/// A step of Halley's method on the slope of the squared distance, a polynomial of degree 5; NaN or `valley` false
/// where that does not lead to the bottom of a valley.
HWY_INLINE double halley(const double slope[6], double t, bool& valley) {
  const double t2 = t * t;
  const double f = slope[0] + slope[1] * t + t2 * (slope[2] + slope[3] * t + t2 * (slope[4] + slope[5] * t));
  const double f1 = slope[1] + 2 * slope[2] * t + t2 * (3 * slope[3] + 4 * slope[4] * t + t2 * (5 * slope[5]));
  const double half_f2 = slope[2] + 3 * slope[3] * t + t2 * (6 * slope[4] + 10 * slope[5] * t);
  const double square = f1 * f1, bottom = square - f * half_f2;
  valley = f1 > 0 && bottom > 0.25 * square;
  return std::min(std::max(t - f * f1 / bottom, 0.0), 1.0);
}

/// The slope of the squared distance from p, over two: curve . derivative is the curve's, the rest depends on p.
struct Slope {
  Slope(const CurveTable& curve, const float p[3]) {
    for (int k = 0; k < 6; ++k) of[k] = curve.slope[k];
    for (int k = 0; k < 3; ++k)
      of[k] -= p[0] * curve.derivative[k][0] + p[1] * curve.derivative[k][1] + p[2] * curve.derivative[k][2];
  }
  double of[6];  // t^0 .. t^5
};

/// Bit i: sample i is not farther than reach2 and has none nearer beside it.
std::uint32_t valleys_of(const SampleScan& scan, float reach2) {
  const Floats f;
  std::uint32_t valleys = 0;
  for (std::size_t i = 0; i < kSamples; i += hn::Lanes(f)) {
    const float* const at = scan.distance2() + i;
    const Row here = hn::Load(f, at);
    const auto lowest = hn::And(hn::Le(here, hn::Set(f, reach2)),
                                hn::And(hn::Lt(here, hn::LoadU(f, at - 1)), hn::Le(here, hn::LoadU(f, at + 1))));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(f, lowest, bits);
    valleys |= static_cast<std::uint32_t>(bits[0]) << i;
  }
  return valleys;
}

/// The bottom of the valley at sample i: its parameter.
float bottom_at(const CurveTable& curve, const Slope& slope, Xyz place, const SampleScan& scan, std::size_t i) {
  // The bottom of the parabola through three samples is a good place to begin.
  const float* const at = scan.distance2() + i;
  const float left = at[0] - *(at - 1), right = at[1] - at[0], bend = right - left;
  const float aside = bend > 0 && bend < kNone ? -0.5f * (left + right) / bend : 0.0f;
  const float start = (static_cast<float>(i) + aside) * (1.0f / (kSamples - 1));
  // After a step that short the next would be of the order of its cube: mostly the first one is.
  double t = start, moved = 1;
  bool valley = true;
  for (int turn = 0; turn < 3 && valley && moved > 4e-3; ++turn) {
    const double next = halley(slope.of, t, valley);
    moved = std::abs(next - t), t = next;
  }
  return valley && moved <= 4e-3 ? static_cast<float>(t) : descend(curve, place, start);
}

/// The nearest point, from each sample that may be the nearest of all (distance2 <= reach2).
CurveHit refine(const CurveTable& curve, const float p[3], const SampleScan& scan, float reach2) {
  const Slope slope(curve, p);
  const Xyz place = {p[0], p[1], p[2], 0};
  CurveHit best{0, kNone};
  for (std::uint32_t valleys = valleys_of(scan, reach2); valleys != 0; valleys &= valleys - 1) {
    const CurveHit found =
        hit_at(curve, place, bottom_at(curve, slope, place, scan, static_cast<std::size_t>(__builtin_ctz(valleys))));
    if (found.distance2 < best.distance2) best = found;
  }
  return best;
}

/// How far a sample may be that leads to the nearest point, squared; where the nearest of all samples is so far.
float reach_of(const CurveTable& curve, float nearest2) {
  const float reach = std::sqrt(nearest2) + curve.reach;
  return std::max(reach * reach, nearest2);  // far away a small reach is lost in rounding
}

float scan_one(const CurveTable& curve, const float p[3]) {
  SampleScan samples;
  const float reach2 = reach_of(curve, scan_samples(curve, p, samples));
  const std::uint32_t valleys = valleys_of(samples, reach2);
  if (valleys == 0 || (valleys & (valleys - 1)) != 0) return refine(curve, p, samples, reach2).t;
  const Xyz place = {p[0], p[1], p[2], 0};
  return bottom_at(curve, Slope(curve, p), place, samples, static_cast<std::size_t>(__builtin_ctz(valleys)));
}

void scan(const CurveTable* curves, std::size_t count, const float p[3], CurveHit* hits) {
  constexpr std::size_t kMost = 64;
  SampleScan scans[kMost];
  float least[kMost];
  float nearest2 = kNone;
  for (std::size_t c = 0; c < count; ++c) {
    least[c] = scan_samples(curves[c], p, scans[c]);
    nearest2 = std::min(nearest2, least[c]);
    hits[c] = {0, kNone};
  }
  for (std::size_t c = 0; c < count; ++c) {
    const float reach2 = reach_of(curves[c], nearest2);
    if (least[c] <= reach2) hits[c] = refine(curves[c], p, scans[c], reach2);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace espalier {

HWY_EXPORT(scan);
HWY_EXPORT(scan_one);

void scan_curves(const CurveTable* curves, std::size_t count, const float p[3], CurveHit* hits) {
  HWY_DYNAMIC_DISPATCH(scan)(curves, count, p, hits);
}

float scan_curve(const CurveTable& curve, const float p[3]) { return HWY_DYNAMIC_DISPATCH(scan_one)(curve, p); }

}  // namespace espalier

#endif  // HWY_ONCE
