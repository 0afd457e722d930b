#include "score/curve_cost.h"

#include <algorithm>
#include <cmath>

#include "base/natural_exp.h"
#include "score/curve_field.h"

namespace espalier {
namespace {

std::int64_t to_units(double cost) {
  // What is no number costs the most: it comes of coordinates beyond all bounds.
  const double kept = cost < kMostCost ? (cost > -kMostCost ? cost : -kMostCost) : kMostCost;
  return static_cast<std::int64_t>(kept / kCostUnit + (kept < 0 ? -0.5 : 0.5));
}

std::vector<CubicBezier> curves_of(const CurveSettings& settings) {
  std::vector<CubicBezier> curves;
  for (const GuidingCurve& guide : settings.curves) curves.push_back(guide.curve);
  return curves;
}

CurveSettings validated(const CurveSettings& settings) {
  validate(settings);
  return settings;
}

/// The parameter at which so much of the curve lies behind.
double parameter_at(const CubicBezier& curve, double length) {
  double low = 0, high = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (length_to(curve, middle) < length ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

CurveCost::CurveCost(const CurveSettings& settings)
    : settings_(validated(settings)), finder_(curves_of(settings_), settings_.blend) {
  for (const GuidingCurve& guide : settings_.curves) {
    rulers_.push_back(make_ruler(guide, all_segments_));
    all_segments_ += rulers_.back().segments;
  }
  if (settings_.density) {
    const BoneDensity& density = *settings_.density;
    for (int axis = 0; axis < 3; ++axis) {
      const double size = static_cast<double>(density.max[axis]) - density.min[axis];
      cells_[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::ceil(size / density.cell));
    }
    wanted_in_cell_ = density.wanted * density.cell * density.cell * density.cell;
  }
  if (settings_.field_cells > 0) field_ = std::make_unique<CurveField>(settings_, finder_);
}

CurveCost::~CurveCost() = default;

CurveCost::Ruler CurveCost::make_ruler(const GuidingCurve& guide, std::uint32_t first) {
  Ruler ruler;
  const double length = length_to(guide.curve, 1);
  ruler.segments = std::max(1u, static_cast<std::uint32_t>(std::ceil(length / guide.segment)));
  ruler.first = first;
  for (std::uint32_t i = 0; i < ruler.segments; ++i) {
    ruler.begins.push_back(i == 0 ? 0 : static_cast<float>(parameter_at(guide.curve, length * i / ruler.segments)));
  }
  ruler.begins.push_back(2);
  std::uint32_t segment = 0;
  for (std::size_t i = 0; i <= Ruler::kGuesses; ++i) {
    const float t = static_cast<float>(i) / Ruler::kGuesses;
    while (t >= ruler.begins[segment + 1]) ++segment;
    ruler.guess[i] = static_cast<std::uint16_t>(segment);
    if (length > 0) ruler.behind[i] = static_cast<float>(length_to(guide.curve, t) / length);
  }
  for (std::size_t n = 0; n < ruler.worth.size(); ++n) {
    ruler.worth[n] = to_units(-guide.utilisation * natural_exp(-static_cast<double>(n)));
  }
  ruler.worth.back() = 0;  // the count stays there
  return ruler;
}

std::uint32_t CurveCost::segment_at(std::uint32_t curve, float t) const {
  const Ruler& ruler = rulers_[curve];
  std::uint32_t segment = ruler.guess[static_cast<std::size_t>(t * Ruler::kGuesses)];
  while (t >= ruler.begins[segment + 1]) ++segment;
  return segment;
}

void CurveCost::reset(CurveTally& tally) const {
  tally.cost = {};
  tally.uses.assign(all_segments_, 0);
  tally.crowd.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2], 0);
}

CurvePoint CurveCost::nearest(const Vec3& base) const { return field_ ? field_->nearest(base) : finder_.nearest(base); }

/// What is left of the distance outside the curve's thickness, m.
float CurveCost::distance_beyond(const GuidingCurve& curve, const CurvePoint& base) const {
  const auto [first, last] = curve.thickness;
  if (first == 0 && last == 0) return base.distance;
  const std::array<float, Ruler::kGuesses + 1>& behind = rulers_[base.curve].behind;
  const float at = base.t * Ruler::kGuesses;
  const std::size_t i = std::min(static_cast<std::size_t>(at), Ruler::kGuesses - 1);
  const double along = behind[i] + (at - static_cast<float>(i)) * (behind[i + 1] - behind[i]);
  return std::max(0.0f, base.distance - static_cast<float>(first + (last - first) * along));
}

std::int64_t CurveCost::alignment(const CurvePoint& base, const Vec3& direction) const {
  const float length2 = direction.x * direction.x + direction.y * direction.y + direction.z * direction.z;
  const Vec3& tangent = base.tangent;
  if (!(length2 > 0) || (tangent.x == 0 && tangent.y == 0 && tangent.z == 0)) return 0;
  const float along = direction.x * tangent.x + direction.y * tangent.y + direction.z * tangent.z;
  const GuidingCurve& curve = settings_.curves[base.curve];
  return to_units((curve.offset - along / std::sqrt(length2)) * curve.alignment);
}

BoneEffect CurveCost::judge(const CurvePoint& base, const Vec3& from, const Vec3& to) const {
  const GuidingCurve& curve = settings_.curves[base.curve];
  const double d = distance_beyond(curve, base);
  BoneEffect effect;
  effect.distance = to_units(curve.distance[0] + d * (curve.distance[1] + d * curve.distance[2]));
  effect.alignment = alignment(base, to - from);
  effect.curve = base.curve;
  if (curve.utilisation > 0) {
    const float tip = field_ ? field_->parameter_on(base.curve, to) : finder_.parameter_on(base.curve, to);
    const std::uint32_t a = segment_at(base.curve, base.t), b = segment_at(base.curve, tip);
    effect.first_segment = static_cast<std::uint16_t>(std::min(a, b));
    effect.last_segment = static_cast<std::uint16_t>(std::max(a, b));
  }
  if (settings_.density) effect.cell = cell_at(0.5f * (from + to));
  return effect;
}

void CurveCost::add(const BoneEffect& effect, CurveTally& tally) const {
  tally.cost[0] += effect.distance;
  tally.cost[1] += effect.alignment;
  const Ruler& ruler = rulers_[effect.curve];
  std::uint8_t* const uses = tally.uses.data() + ruler.first;
  for (std::uint32_t s = effect.first_segment; s <= effect.last_segment; ++s) {
    tally.cost[2] += ruler.worth[uses[s]];
    uses[s] += uses[s] < 255;
  }
  if (effect.cell == 0xffff) return;
  std::uint16_t& bones = tally.crowd[effect.cell];
  if (bones == 65535) return;
  tally.cost[3] += crowd_cost(bones + 1.0) - crowd_cost(bones);
  ++bones;
}

/// Of so many bones in one cell.
std::int64_t CurveCost::crowd_cost(double bones) const {
  const double excess = bones - wanted_in_cell_;
  return excess > 0 ? to_units(settings_.density->cost * excess * excess) : 0;
}

std::uint16_t CurveCost::cell_at(const Vec3& p) const {
  const BoneDensity& density = *settings_.density;
  std::size_t cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<int>(axis);
    const double at = (static_cast<double>(p[a]) - density.min[a]) / density.cell;
    if (!(at >= 0 && p[a] <= density.max[a])) return 0xffff;
    cell = cell * cells_[axis] + std::min(static_cast<std::uint32_t>(at), cells_[axis] - 1);
  }
  return static_cast<std::uint16_t>(cell);
}

}  // namespace espalier
