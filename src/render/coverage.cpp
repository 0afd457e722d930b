#include "render/coverage.h"

#include <algorithm>

#include "base/box_corner.h"

namespace espalier {
namespace {

constexpr float kSlack = 1;         // pixels, for rounding
constexpr float kNearest = 1e-3f;   // what comes nearer to the eye may show anywhere

}  // namespace

Coverage::Coverage(const Camera& camera, std::uint32_t width, std::uint32_t height)
    : camera_(camera),
      width_(width),
      height_(height),
      columns_((width + kTile - 1) / kTile),
      rows_((height + kTile - 1) / kTile),
      marked_(columns_ * rows_) {}

void Coverage::add(const Tracer& tracer) {
  for (std::size_t i = 0; i < tracer.size(); ++i) add(tracer.part(static_cast<std::uint32_t>(i)));
}

void Coverage::add(const Placed& part) {
  const Bounds box = part.shape->box();
  Vec2 low(1e30f), high(-1e30f);
  bool near = false;
  for (int k = 0; k < 8; ++k) {
    const Vec3 p = camera_.picture_point(part.world_from_shape.point(corner_of(box, k)));
    near |= !(p.z > kNearest);
    low = Vec2(std::min(low.x, p.x), std::min(low.y, p.y));
    high = Vec2(std::max(high.x, p.x), std::max(high.y, p.y));
  }
  const auto tile = [](float pixel, std::size_t count) {
    const float t = pixel / kTile;
    return t > 0 ? std::min(static_cast<std::size_t>(std::min(t, 1e9f)), count - 1) : 0;
  };
  const float w = static_cast<float>(width_), h = static_cast<float>(height_);
  const float left = (low.x + 1) / 2 * w - kSlack, right = (high.x + 1) / 2 * w + kSlack;
  const float top = (1 - high.y) / 2 * h - kSlack, bottom = (1 - low.y) / 2 * h + kSlack;
  if (!near && (right < 0 || bottom < 0 || left > w || top > h)) return;
  const std::size_t x0 = near ? 0 : tile(left, columns_), x1 = near ? columns_ - 1 : tile(right, columns_);
  const std::size_t y0 = near ? 0 : tile(top, rows_), y1 = near ? rows_ - 1 : tile(bottom, rows_);
  for (std::size_t y = y0; y <= y1; ++y) {
    std::fill_n(marked_.begin() + static_cast<std::ptrdiff_t>(x0 + columns_ * y), x1 - x0 + 1, std::uint8_t{1});
  }
}

}  // namespace espalier
