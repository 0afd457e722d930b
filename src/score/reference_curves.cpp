#include "score/reference_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

DVec3 mix(const DVec3& a, const DVec3& b, double t) { return (1 - t) * a + t * b; }

/// De Casteljau's construction.
DVec3 on_curve(const CubicBezier& curve, double t) {
  const DVec3 p0(curve.points[0]), p1(curve.points[1]), p2(curve.points[2]), p3(curve.points[3]);
  const DVec3 a = mix(p0, p1, t), b = mix(p1, p2, t), c = mix(p2, p3, t);
  return mix(mix(a, b, t), mix(b, c, t), t);
}

}  // namespace

ReferenceCurves::ReferenceCurves(const CurveSettings& settings) : settings_(settings) {
  for (const GuidingCurve& guide : settings_.curves) {
    std::vector<DVec3>& samples = samples_.emplace_back();
    for (std::size_t i = 0; i <= kSamples; ++i) {
      samples.push_back(on_curve(guide.curve, static_cast<double>(i) / kSamples));
    }
    std::vector<double>& lengths = lengths_.emplace_back(1, 0.0);
    for (std::size_t i = 0; i < kSamples; ++i) {
      lengths.push_back(lengths.back() + glm::length(samples[i + 1] - samples[i]));
    }
  }
}

DVec3 ReferenceCurves::point(std::size_t curve, double t) const { return on_curve(settings_.curves[curve].curve, t); }

DVec3 ReferenceCurves::tangent(std::size_t curve, double t) const {
  // Ever longer steps, until one leads somewhere.
  for (double step = 1e-7; step < 1; step *= 10) {
    const double from = t + step <= 1 ? t : t - step, to = t + step <= 1 ? t + step : t;
    const DVec3 way = point(curve, to) - point(curve, from);
    const double size = glm::length(way), rounding = 1e-11 * (glm::length(samples_[curve][0]) + length(curve));
    if (size > rounding) return way / size;
  }
  return DVec3(0);
}

double ReferenceCurves::distance_at(std::size_t curve, double t, const DVec3& p) const {
  return glm::length(point(curve, t) - p);
}

/// The parameter of the least distance between two, where there is one valley.
double ReferenceCurves::golden_section(std::size_t curve, const DVec3& p, double low, double high) const {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = distance_at(curve, a, p), at_b = distance_at(curve, b, p);
  for (int i = 0; i < 60; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - ratio * (high - low), at_a = distance_at(curve, a, p);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + ratio * (high - low), at_b = distance_at(curve, b, p);
    }
  }
  return 0.5 * (low + high);
}

ReferencePoint ReferenceCurves::closest(std::size_t curve, const DVec3& p) const {
  const std::vector<DVec3>& samples = samples_[curve];
  std::vector<double> distances;
  double least = kInfinity, longest_step = 0;
  for (std::size_t i = 0; i <= kSamples; ++i) {
    distances.push_back(glm::length(samples[i] - p));
    least = std::min(least, distances.back());
    if (i > 0) longest_step = std::max(longest_step, glm::length(samples[i] - samples[i - 1]));
  }
  ReferencePoint best;
  best.curve = curve;
  best.distance = best.rival = kInfinity;
  for (std::size_t i = 0; i <= kSamples; ++i) {
    const bool falls = i > 0 && distances[i - 1] <= distances[i], rises = i < kSamples && distances[i + 1] < distances[i];
    if (falls || rises) continue;  // no valley
    double t = static_cast<double>(i) / kSamples, distance = distances[i];
    if (distance < least + longest_step) {
      const double low = static_cast<double>(i > 0 ? i - 1 : 0) / kSamples;
      const double high = static_cast<double>(std::min(i + 1, kSamples)) / kSamples;
      const double finer = golden_section(curve, p, low, high);
      if (distance_at(curve, finer, p) < distance) t = finer, distance = distance_at(curve, finer, p);
    }
    if (distance < best.distance) {
      best.rival = best.distance;
      best.distance = distance;
      best.t = t;
    } else {
      best.rival = std::min(best.rival, distance);
    }
  }
  best.tangent = tangent(curve, best.t);
  return best;
}

ReferencePoint ReferenceCurves::nearest(const DVec3& p) const {
  std::vector<ReferencePoint> points;
  for (std::size_t i = 0; i < settings_.curves.size(); ++i) points.push_back(closest(i, p));
  std::stable_sort(points.begin(), points.end(),
                   [](const ReferencePoint& a, const ReferencePoint& b) { return a.distance < b.distance; });
  ReferencePoint found = points[0];
  if (points.size() == 1) return found;
  found.rival = std::min(found.rival, points[1].distance);
  if (settings_.blend) {
    const DVec3 sum = points[1].distance * points[0].tangent + points[0].distance * points[1].tangent;
    if (glm::length(sum) > 0) found.tangent = glm::normalize(sum);
  }
  return found;
}

double ReferenceCurves::length_to(std::size_t curve, double t) const {
  const std::vector<double>& lengths = lengths_[curve];
  const std::size_t i = std::min(static_cast<std::size_t>(t * kSamples), kSamples - 1);
  return lengths[i] + (t * kSamples - static_cast<double>(i)) * (lengths[i + 1] - lengths[i]);
}

std::size_t ReferenceCurves::segments(std::size_t curve) const {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length(curve) / settings_.curves[curve].segment)));
}

double ReferenceCurves::segments_to(std::size_t curve, double t) const {
  if (length(curve) == 0) return 0;
  return static_cast<double>(segments(curve)) * length_to(curve, t) / length(curve);
}

double ReferenceCurves::alignment(const ReferencePoint& base, const DVec3& direction) const {
  const GuidingCurve& guide = settings_.curves[base.curve];
  if (direction == DVec3(0) || base.tangent == DVec3(0)) return 0;
  const DVec3 bone = -direction / glm::length(direction);             // equation 4
  return (glm::dot(bone, base.tangent) + guide.offset) * guide.alignment;  // equation 6
}

double ReferenceCurves::distance_cost(const ReferencePoint& base) const {
  const GuidingCurve& guide = settings_.curves[base.curve];
  const double whole = length(base.curve);
  const double along = whole > 0 ? length_to(base.curve, base.t) / whole : 0;
  const double radius = guide.thickness[0] + along * (guide.thickness[1] - guide.thickness[0]);
  const double beyond = std::max(0.0, base.distance - radius);
  return guide.distance[0] + guide.distance[1] * beyond + guide.distance[2] * beyond * beyond;
}

ReferenceCosts ReferenceCurves::costs(std::span<const Bone> bones) const {
  ReferenceCosts sum;
  std::map<std::pair<std::size_t, std::size_t>, int> uses;  // of a curve's segment
  for (const Bone& bone : bones) {
    const ReferencePoint base = nearest(DVec3(bone.from));
    const GuidingCurve& guide = settings_.curves[base.curve];
    sum.distance += distance_cost(base);
    sum.alignment += alignment(base, DVec3(bone.to) - DVec3(bone.from));
    const double at_base = segments_to(base.curve, base.t);
    const double at_tip = segments_to(base.curve, closest(base.curve, DVec3(bone.to)).t);
    const auto last = static_cast<double>(segments(base.curve) - 1);
    const auto first_used = static_cast<std::size_t>(std::min(std::min(at_base, at_tip), last));
    const auto last_used = static_cast<std::size_t>(std::min(std::max(at_base, at_tip), last));
    for (std::size_t s = first_used; s <= last_used; ++s) {
      sum.utilisation -= guide.utilisation * std::exp(-uses[{base.curve, s}]++);  // equation 7
    }
  }
  sum.density = density_cost(bones);
  return sum;
}

double ReferenceCurves::density_cost(std::span<const Bone> bones) const {
  if (!settings_.density) return 0;
  const BoneDensity& density = *settings_.density;
  std::map<std::vector<int>, int> counts;
  for (const Bone& bone : bones) {
    const DVec3 middle = 0.5 * (DVec3(bone.from) + DVec3(bone.to));
    std::vector<int> cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = density.min[axis], high = density.max[axis];
      if (middle[axis] < low || middle[axis] > high) break;
      // What lies on the far side belongs to the last cell.
      const double cells = std::ceil((high - low) / density.cell);
      cell.push_back(static_cast<int>(std::min((middle[axis] - low) / density.cell, cells - 1)));
    }
    if (cell.size() == 3) ++counts[cell];
  }
  double cost = 0;
  for (const auto& [cell, bones_there] : counts) {
    const double excess = bones_there - density.wanted * density.cell * density.cell * density.cell;
    if (excess > 0) cost += density.cost * excess * excess;
  }
  return cost;
}

}  // namespace espalier
