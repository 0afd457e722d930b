// Feeds any numbers to guiding curves: what their rules let through is judged without overflow or fault, nearest points lie
// on the curve and are no farther than any of its samples, and an account is the sum of its bones in any order.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/check.h"
#include "base/error.h"
#include "score/curve_cost.h"

namespace espalier {
namespace {

/// Numbers one after the other; zeros when there are no more.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
  bool done() const { return at_ >= size_; }
  /// A small fraction, mostly: whole ones and halves meet each other. Any bits at all, else.
  float number() {
    const std::uint8_t kind = byte();
    if (kind < 192) return static_cast<float>(static_cast<std::int8_t>(byte())) / 16;
    std::array<std::uint8_t, 4> bytes;
    for (std::uint8_t& b : bytes) b = byte();
    float value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  Vec3 point() {
    const float x = number(), y = number();
    return {x, y, number()};
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

CurveSettings read_settings(Numbers& numbers) {
  CurveSettings settings;
  const std::uint8_t shape = numbers.byte();
  settings.curves.resize(1 + shape % 4);
  settings.blend = shape & 16;
  if ((shape & 96) == 96) settings.field_cells = 8;
  for (GuidingCurve& guide : settings.curves) {
    for (Vec3& point : guide.curve.points) point = numbers.point();
    if (numbers.byte() < 128) continue;
    for (double& scale : guide.distance) scale = numbers.number();
    guide.alignment = numbers.number(), guide.offset = numbers.number();
    guide.utilisation = numbers.number(), guide.segment = numbers.number();
    for (double& radius : guide.thickness) radius = numbers.number();
  }
  if (shape & 128) {
    BoneDensity& density = settings.density.emplace();
    density.min = numbers.point(), density.max = numbers.point();
    density.cell = numbers.number(), density.wanted = numbers.number(), density.cost = numbers.number();
  }
  return settings;
}

double distance(const DVec3& a, const DVec3& b) {
  const DVec3 d = a - b;
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

void check_nearest(const CurveSettings& settings, const CurvePoint& found, const Vec3& p) {
  CHECK(found.curve < settings.curves.size());
  CHECK(found.t >= 0 && found.t <= 1);
  double largest = 1;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(static_cast<double>(p[axis])));
  for (const GuidingCurve& guide : settings.curves)
    for (const Vec3& corner : guide.curve.points)
      for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(static_cast<double>(corner[axis])));
  const double size = distance(DVec3(found.tangent), DVec3(0));
  CHECK(size < 1e-3 || std::abs(size - 1) < 1e-3);
  if (settings.field_cells != 0) return;
  const double here = distance(point_at(settings.curves[found.curve].curve, found.t), DVec3(p));
  CHECK(std::abs(here - found.distance) <= 1e-4 * largest);
  for (const GuidingCurve& guide : settings.curves)
    for (int i = 0; i <= 64; ++i) CHECK(here <= distance(point_at(guide.curve, i / 64.0), DVec3(p)) + 1e-4 * largest);
}

void exercise(const CurveSettings& settings, Numbers& numbers) {
  const CurveCost cost(settings);
  std::vector<BoneEffect> effects;
  while (!numbers.done() && effects.size() < 20) {
    const Vec3 from = numbers.point(), to = numbers.point();
    const CurvePoint base = cost.nearest(from);
    bool plain = true;  // within what models are let through with
    for (int axis = 0; axis < 3; ++axis) plain = plain && std::abs(from[axis]) < 1e5f && std::abs(to[axis]) < 1e5f;
    if (!plain) continue;
    check_nearest(settings, base, from);
    effects.push_back(cost.judge(base, from, to));
    CHECK(effects.back().last_segment < cost.segments(base.curve));
  }
  CurveTally forward, backward;
  cost.reset(forward), cost.reset(backward);
  for (const BoneEffect& effect : effects) cost.add(effect, forward);
  std::reverse(effects.begin(), effects.end());
  for (const BoneEffect& effect : effects) cost.add(effect, backward);
  CHECK(forward == backward);
}

}  // namespace
}  // namespace espalier

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  espalier::Numbers numbers(data, size);
  const espalier::CurveSettings settings = espalier::read_settings(numbers);
  try {
    espalier::validate(settings);
  } catch (const espalier::Error&) {
    return 0;
  }
  espalier::exercise(settings, numbers);
  return 0;
}
