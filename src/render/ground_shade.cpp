#include "render/ground_shade.h"

#include <algorithm>
#include <cmath>

#include "base/box_corner.h"

namespace espalier {

GroundShade::GroundShade(const Stage& stage, const Tracer& tracer) : marked_(std::size_t{kSide} * kSide) {
  for (std::size_t i = 0; i < tracer.size(); ++i) add(stage, tracer.part(static_cast<std::uint32_t>(i)));
}

void GroundShade::add(const Stage& stage, const Placed& part) {
  const Vec3& key = stage.to_key;
  const Vec2 level(key.x, key.z);
  // A direction k + e with |e| <= s meets the ground at most so far from where k does, per unit of height.
  const float aside = kKeySpread * (key.y + std::sqrt(level.x * level.x + level.y * level.y)) /
                      (key.y * (key.y - kKeySpread));
  const Bounds box = part.shape->box();
  Vec2 low(1e30f), high(-1e30f);
  for (int k = 0; k < 8; ++k) {
    const Vec3 p = part.world_from_shape.point(corner_of(box, k));
    const float height = std::max(p.y - stage.ground_y, 0.0f), radius = 1.01f * aside * height;
    const Vec2 foot = Vec2(p.x, p.z) - (height / key.y) * level;
    low = Vec2(std::min(low.x, foot.x - radius), std::min(low.y, foot.y - radius));
    high = Vec2(std::max(high.x, foot.x + radius), std::max(high.y, foot.y + radius));
  }
  // A cell more on each side, for rounding and for where shadow rays start.
  const auto cell = [](float x, int more) {
    const float cells = (x + kReach) * kCellsPerLength;
    return std::clamp(static_cast<int>(std::floor(std::clamp(cells, -9.0f, kSide + 9.0f))) + more, 0, kSide - 1);
  };
  const int x0 = cell(low.x, -1), x1 = cell(high.x, 1);
  for (int z = cell(low.y, -1); z <= cell(high.y, 1); ++z)
    std::fill(marked_.begin() + x0 + kSide * z, marked_.begin() + x1 + 1 + kSide * z, std::uint8_t{1});
}

}  // namespace espalier
