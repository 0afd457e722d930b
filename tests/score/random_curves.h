#pragma once
// Guiding curves and skeletons at random, and where their reference is sure of itself.

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "base/random.h"
#include "score/reference_curves.h"

namespace espalier::test {

inline RandomStream curve_stream(std::uint32_t index) { return RandomStream({2018, Purpose::test, 0, index}); }

/// In -size..size along every axis.
inline Vec3 random_place(RandomStream& random, double size) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(size * (2 * random.next_unit() - 1));
  return p;
}

enum class CurveShape { wild, line, folded_line, loop, cusp, standing_start, standing_end, point };
inline constexpr CurveShape kCurveShapes[] = {CurveShape::wild,           CurveShape::line, CurveShape::folded_line,
                                              CurveShape::loop,           CurveShape::cusp, CurveShape::standing_start,
                                              CurveShape::standing_end, CurveShape::point};

/// Within about a metre of the origin.
inline CubicBezier random_curve(RandomStream& random, CurveShape shape = CurveShape::wild) {
  CubicBezier curve;
  for (Vec3& p : curve.points) p = random_place(random, 1);
  auto& [p0, p1, p2, p3] = curve.points;
  const Vec3 whole = p3 - p0;
  switch (shape) {
    case CurveShape::wild: break;
    case CurveShape::line: p1 = p0 + whole / 3.0f, p2 = p0 + whole * (2 / 3.0f); break;
    case CurveShape::folded_line:  // there, back, and there again
      p1 = p0 + whole * static_cast<float>(1.5 + random.next_unit());
      p2 = p0 - whole * static_cast<float>(0.5 + random.next_unit());
      break;
    case CurveShape::loop: p3 = p0 + random_place(random, 0.01); break;
    case CurveShape::cusp: p3 = p0 - p2 + p1; break;  // in the middle it stands still
    case CurveShape::standing_start:
      p1 = p0;
      if (random.chance(0.5)) p2 = p0;
      break;
    case CurveShape::standing_end:
      p2 = p3;
      if (random.chance(0.5)) p1 = p3;
      break;
    case CurveShape::point: p1 = p2 = p3 = p0; break;
  }
  return curve;
}

/// Curves that bend no more than people draw them.
inline CubicBezier gentle_curve(RandomStream& random) {
  const Vec3 start = random_place(random, 1), way = random_place(random, 1);
  CubicBezier curve;
  for (int i = 0; i < 4; ++i) {
    curve.points[static_cast<std::size_t>(i)] =
        start + way * (0.4f * static_cast<float>(i)) + (i > 0 ? random_place(random, 0.3) : Vec3(0));
  }
  return curve;
}

/// Every setting is another number for every curve.
inline CurveSettings random_settings(RandomStream& random, std::size_t curves) {
  CurveSettings settings;
  for (std::size_t i = 0; i < curves; ++i) {
    GuidingCurve& guide = settings.curves.emplace_back();
    guide.curve = gentle_curve(random);
    guide.distance = {10 * random.next_unit(), 50 * random.next_unit(), 100 * random.next_unit()};
    guide.alignment = 400 * random.next_unit();
    guide.offset = 2 * random.next_unit() - 1;
    guide.utilisation = 5 + 20 * random.next_unit();
    guide.segment = 0.05 + 0.3 * random.next_unit();
  }
  return settings;
}

/// The nearest point is no near tie, and moves little when p does: floats must agree there.
inline bool is_steady(const ReferenceCurves& reference, const DVec3& p) {
  const ReferencePoint at = reference.nearest(p);
  if (at.rival - at.distance < 1e-3) return false;
  for (const double aside : {-1e-4, 1e-4}) {
    for (int axis = 0; axis < 3; ++axis) {
      DVec3 q = p;
      q[axis] += aside;
      const ReferencePoint beside = reference.nearest(q);
      if (beside.curve != at.curve || std::abs(beside.t - at.t) > 0.002) return false;
    }
  }
  return true;
}

/// Further than a thousandth of a segment from the border of one.
inline bool is_within_segment(const ReferenceCurves& reference, std::size_t curve, double t) {
  const double at = reference.segments_to(curve, t), share = at - std::floor(at);
  const bool at_end = t <= 0 || t >= 1;
  return at_end || (share > 1e-3 && share < 1 - 1e-3);
}

/// A bone about which reference and kernel cannot disagree but by rounding.
inline bool is_steady(const ReferenceCurves& reference, const Bone& bone) {
  if (!is_steady(reference, DVec3(bone.from))) return false;
  const ReferencePoint base = reference.nearest(DVec3(bone.from));
  if (!is_within_segment(reference, base.curve, base.t)) return false;
  for (const double aside : {0.0, -1e-4, 1e-4}) {
    const ReferencePoint tip = reference.closest(base.curve, DVec3(bone.to) + DVec3(aside));
    if (tip.rival - tip.distance < 1e-3 || !is_within_segment(reference, base.curve, tip.t)) return false;
  }
  return true;
}

inline Bone bone_between(const Vec3& from, const Vec3& to) {
  Bone bone;
  bone.from = from;
  bone.to = to;
  return bone;
}

/// Steady bones around the curves, none longer than half a metre or so.
inline std::vector<Bone> random_skeleton(const ReferenceCurves& reference, RandomStream& random, std::size_t bones) {
  std::vector<Bone> skeleton;
  while (skeleton.size() < bones) {
    const Vec3 from = random_place(random, 1.5);
    const Bone bone = bone_between(from, from + random_place(random, 0.3));
    if (is_steady(reference, bone)) skeleton.push_back(bone);
  }
  return skeleton;
}

}  // namespace espalier::test
