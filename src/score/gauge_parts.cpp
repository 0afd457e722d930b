// The measures of parts. As many models are measured as are scored, so four floats are worked on at once, by exact
// IEEE operations only.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "base/check.h"
#include "model/parts.h"
#include "score/gauge.h"

namespace espalier {
namespace {

using Four = float __attribute__((vector_size(16)));
using Mask = std::int32_t __attribute__((vector_size(16)));

// The box of a turned part may be larger than the part: it only tells whether its corners need be looked at. Widened,
// so that its rounding hides no corner.
constexpr float kWider = 1 + 1e-5f;

Four all(float x) { return Four{x, x, x, x}; }
Four absolute(Four x) { return reinterpret_cast<Four>(reinterpret_cast<Mask>(x) & 0x7fffffff); }
Four smaller(Four a, Four b) { return a < b ? a : b; }
Four larger(Four a, Four b) { return a > b ? a : b; }

/// A frame, three floats a vector; the fourth is whatever follows in the instance.
struct FourFrame {
  Four basis[3], origin;

  explicit FourFrame(const Instance& instance) {
    static_assert(std::is_standard_layout_v<Instance> && offsetof(Instance, model_from_mesh) == 0);
    static_assert(sizeof(Frame) == 12 * sizeof(float) && sizeof(Instance) >= 13 * sizeof(float));
    const char* bytes = reinterpret_cast<const char*>(&instance);
    for (int i = 0; i < 3; ++i) std::memcpy(&basis[i], bytes + 12 * i, sizeof(Four));
    std::memcpy(&origin, bytes + 36, sizeof(Four));
  }
};

double determinant(const Mat3& m) {
  const double ax = m[0].x, ay = m[0].y, az = m[0].z, bx = m[1].x, by = m[1].y, bz = m[1].z;
  return (ay * bz - az * by) * m[2].x + (az * bx - ax * bz) * m[2].y + (ax * by - ay * bx) * m[2].z;
}

/// Bounds as vectors; the fourth lane means nothing.
struct FourBounds {
  Four min = all(1e30f), max = all(-1e30f);

  bool holds(Four low, Four high) const {
    const Mask out = (low < min) | (high > max);
    return (out[0] | out[1] | out[2]) == 0;
  }
  void add(Four low, Four high) { min = smaller(low, min), max = larger(high, max); }
  double extent(int axis) const {
    return min[axis] <= max[axis] ? static_cast<double>(max[axis]) - static_cast<double>(min[axis]) : 0;
  }
};

}  // namespace

struct Gauge::Sums {
  std::uint64_t parts = 0, triangles = 0;
  double volume = 0;
  FourBounds box;

  /// `size`: of the basis, absolute.
  void add_box(const Solid& solid, const FourFrame& frame, const Four (&size)[3], float top) {
    Four centre = frame.origin;
    if (!solid.centred) {
      for (int i = 0; i < 3; ++i) centre += frame.basis[i] * all(solid.centre[i]);
    }
    const float widest = std::max(top, 1.0f);
    const Four reach = size[0] * all(solid.half.x * widest) + size[1] * all(solid.half.y) +
                       size[2] * all(solid.half.z * widest);
    if (solid.corners.empty()) return box.add(centre - reach, centre + reach);
    if (box.holds(centre - all(kWider) * reach, centre + all(kWider) * reach)) return;
    for (const Vec3& p : solid.corners) {
      const float wide = p.y > 0 ? top : 1;
      const Four at = frame.origin + frame.basis[0] * all(p.x * wide) + frame.basis[1] * all(p.y) +
                      frame.basis[2] * all(p.z * wide);
      box.add(at, at);
    }
  }
};

double Gauge::volume_of(const Solid& solid, const Frame& frame, float top) const {
  const double t = top, of_mesh = std::abs(determinant(frame.basis)) * solid.volume;
  return solid.cone ? of_mesh * (1 + t + t * t) / 3 : of_mesh;  // between radii 1 and t, of the cylinder's
}

/// Adds up the parts that the view shows. False, and sums that mean nothing, if `check_each` was needed: some frame is
/// beyond what can be shown.
bool Gauge::add_parts(std::span<const Instance> instances, bool check_each, Sums& sums) const {
  const bool wants_box = wanted_[Measure::height] || wanted_[Measure::spread], wants_volume = wanted_[Measure::volume];
  Mask shown = {-1, -1, -1, -1};
  for (const Instance& instance : instances) {
    if (!shows(view_, instance)) continue;
    if (check_each && !can_be_shown(instance.model_from_mesh)) continue;
    const FourFrame frame(instance);
    const Four size[3] = {absolute(frame.basis[0]), absolute(frame.basis[1]), absolute(frame.basis[2])};
    const Mask near = absolute(frame.origin) <= kFarthestShown;
    shown &= (size[0] <= kFarthestShown) & (size[1] <= kFarthestShown) & (size[2] <= kFarthestShown) &
             (near | Mask{0, 0, 0, -1});
    const Solid& solid = solids_[instance.mesh];
    const float top = solid.cone ? std::max(instance.top, 0.0f) : 1;
    ++sums.parts;
    sums.triangles += top > 0 ? solid.triangles : solid.pointed;
    if (wants_volume) sums.volume += volume_of(solid, instance.model_from_mesh, top);
    if (wants_box && !solid.empty) sums.add_box(solid, frame, size, top);
  }
  return (shown[0] & shown[1] & shown[2] & shown[3]) != 0;
}

void Gauge::measure_parts(std::span<const Instance> instances, PerMeasure<double>& out) const {
  Sums sums;
  if (!add_parts(instances, false, sums)) {
    sums = {};
    CHECK(add_parts(instances, true, sums));
  }
  out[Measure::parts] = static_cast<double>(sums.parts);
  out[Measure::triangles] = static_cast<double>(sums.triangles);
  out[Measure::volume] = sums.volume;
  out[Measure::height] = sums.box.extent(1);
  out[Measure::spread] = std::max(sums.box.extent(0), sums.box.extent(2));
}

}  // namespace espalier
