// Bark: plates, longer than wide, with furrows between them; cracks break the plates, fibres run along them. `bands`
// lays the dark strokes of a birch across.

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/texture.h"
#include "model/texture_paint.h"

namespace espalier {
namespace {

/// What is known of one point.
struct Spot {
  float height = 0;  // 0 in the furrows, 1 on the plates
  float tint = 0;    // -1..1, one for each plate
};

class Bark {
 public:
  explicit Bark(const TextureRef& texture)
      : cracks_(texture_number(texture, "cracks")),
        waves_(texture_number(texture, "waves")),
        bands_(texture_number(texture, "bands")),
        seed_(64 * static_cast<std::uint32_t>(texture_number(texture, "seed"))) {
    const float across = std::floor(texture_number(texture, "furrows") + 0.5f);
    const float up = std::max(2.0f, std::floor(across * (0.2f + 0.45f * cracks_) + 0.5f));
    plates_ = {static_cast<std::int32_t>(across), static_cast<std::int32_t>(up)};
    aspect_ = across / up;
    waves_ *= std::min(1.0f, across / 8);  // wide plates would be folded over each other
    for (std::int32_t y = 0; y < plates_.y; ++y) {
      for (std::int32_t x = 0; x < plates_.x; ++x) points_.push_back(cell_point(x, y, plates_, 0.85f, seed_));
    }
  }

  Spot at(float u, float v) const {
    // Furrows wander: the plates' lattice is bent by slow and by quick waves.
    const float slow = fractal_noise({3 * u, 2 * v}, {3, 2}, 3, seed_ + 8);
    const float quick = fractal_noise({9 * u, 7 * v}, {9, 7}, 3, seed_ + 16);
    const float rough = fractal_noise({48 * u, 24 * v}, {48, 24}, 3, seed_ + 24);
    const float bend = waves_ * (0.60f * slow + 0.22f * quick) + 0.035f * rough;
    Spot spot = plate({u * static_cast<float>(plates_.x) + 1.1f * bend,
                       v * static_cast<float>(plates_.y) + 0.25f * quick + 0.06f * rough});
    // Fibres run upwards, and the plates' faces are scaly.
    const float fibres = fractal_noise({40 * u + 1.5f * slow, 5 * v}, {40, 5}, 4, seed_ + 32, 0.5f);
    const float scales = fractal_noise({18 * u, 14 * v}, {18, 14}, 5, seed_ + 40, 0.3f);
    spot.height *= 0.78f + 0.17f * fibres + 0.16f * scales;
    spot.height += 0.06f * fibres + 0.05f * rough;
    return spot;
  }

  /// How dark the strokes of a birch are here, 0..1.
  float band(float u, float v) const {
    if (!(bands_ > 0)) return 0;
    constexpr Periods kRows{3, 22};
    const float ragged = fractal_noise({16 * u, 40 * v}, {16, 40}, 3, seed_ + 48);
    const Vec2 p(3 * u, 22 * v + 0.25f * ragged);
    const auto cx = static_cast<std::int32_t>(std::floor(p.x)), cy = static_cast<std::int32_t>(std::floor(p.y));
    float most = 0;
    for (std::int32_t y = cy - 1; y <= cy + 1; ++y) {
      for (std::int32_t x = cx - 1; x <= cx + 1; ++x) {
        const Vec2 d = p - cell_point(x, y, kRows, 0.9f, seed_ + 56);
        const float chance = unit_hash(wrapped(x, kRows.x), wrapped(y, kRows.y), seed_ + 57);
        const float length = 0.10f + 0.75f * chance * chance, thick = 0.10f + 0.22f * chance;
        const float e = (d.x / length) * (d.x / length) + (d.y / thick) * (d.y / thick);
        most = std::max(most, 1 - smooth_step(0.55f, 1.05f, e + 0.35f * ragged));
      }
    }
    return bands_ * most;
  }

 private:
  /// The plate that a point lies on, and how far it is from the nearest furrow, in widths of that furrow.
  Spot plate(const Vec2& p) const {
    const auto cx = static_cast<std::int32_t>(std::floor(p.x)), cy = static_cast<std::int32_t>(std::floor(p.y));
    Vec2 own(0);
    std::int32_t own_x = 0, own_y = 0;
    float nearest = 1e9f;
    for (std::int32_t y = cy - 1; y <= cy + 1; ++y) {
      for (std::int32_t x = cx - 1; x <= cx + 1; ++x) {
        const Vec2 q = point(x, y), d = q - p;
        const float distance = d.x * d.x + d.y * d.y;
        if (distance < nearest) nearest = distance, own = q, own_x = x, own_y = y;
      }
    }
    float closest = 4;
    for (std::int32_t y = own_y - 2; y <= own_y + 2; ++y) {
      for (std::int32_t x = own_x - 2; x <= own_x + 2; ++x) {
        if (x == own_x && y == own_y) continue;
        closest = std::min(closest, to_furrow(p, own, point(x, y)));
      }
    }
    Spot spot;
    spot.height = smooth_step(0.05f, 1, closest);
    spot.tint = 2 * unit_hash(wrapped(own_x, plates_.x), wrapped(own_y, plates_.y), seed_ + 1) - 1;
    return spot;
  }

  /// The middle of a plate; the lattice goes on beyond its periods.
  Vec2 point(std::int32_t x, std::int32_t y) const {
    const std::int32_t wx = wrapped(x, plates_.x), wy = wrapped(y, plates_.y);
    const Vec2& known = points_[static_cast<std::size_t>(wx + plates_.x * wy)];
    return {known.x + static_cast<float>(x - wx), known.y + static_cast<float>(y - wy)};
  }

  /// The distance to the border between two plates' points, in its widths; borders that lie across are thin cracks.
  float to_furrow(const Vec2& p, const Vec2& own, const Vec2& other) const {
    const Vec2 between = other - own;
    const float length = std::sqrt(between.x * between.x + between.y * between.y);
    if (!(length > 1e-4f)) return 4;
    const Vec2 n = between / length, middle = 0.5f * (own + other) - p;
    // In units of a furrow's spacing: cells are `aspect` times as tall as wide.
    const float ny = n.y / aspect_, size = std::sqrt(n.x * n.x + ny * ny);
    const float distance = (middle.x * n.x + middle.y * n.y) / size;
    const float across = (ny / size) * (ny / size);  // 1: the border is level
    const float width = mix_of(0.36f, 0.05f + 0.13f * cracks_, across);
    const float shallow = across * (1 - cracks_);    // cracks that are hardly there
    return distance / width + 0.7f * shallow;
  }

  float cracks_, waves_, bands_;
  std::uint32_t seed_;
  Periods plates_;
  std::vector<Vec2> points_;  // of one period
  float aspect_ = 1;
};

}  // namespace

Image make_bark(const TextureRef& texture, std::uint32_t size) {
  const Bark bark(texture);
  const Vec3 dark = perceived(texture.colors[0]), light = perceived(texture.colors[1]);
  const float contrast = texture_number(texture, "contrast");
  const auto seed = 64 * static_cast<std::uint32_t>(texture_number(texture, "seed"));
  const float step = 1 / static_cast<float>(size);
  std::vector<Spot> spots;
  spots.reserve(std::size_t{size} * size);
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x)
      spots.push_back(bark.at((static_cast<float>(x) + 0.5f) * step, 1 - (static_cast<float>(y) + 0.5f) * step));
  }
  const auto spot = [&](std::uint32_t x, std::uint32_t y) -> const Spot& {
    return spots[x % size + std::size_t{size} * (y % size)];
  };
  // A little light from above the relief: the difference of heights over 1/256 of the picture.
  const std::uint32_t reach = std::max(1u, size / 256);
  return paint_image(size, [&](float u, float v, float&) {
    const auto x = static_cast<std::uint32_t>(u * static_cast<float>(size));
    const auto y = static_cast<std::uint32_t>((1 - v) * static_cast<float>(size));
    const Spot& here = spot(x, y);
    const float rise = spot(x + reach, y + reach).height - spot(x + size - reach, y + size - reach).height;
    const float broad = fractal_noise({4 * u, 3 * v}, {4, 3}, 4, seed + 60);
    const float lit = here.height + 0.10f * here.tint * here.height + 0.10f * broad - 0.16f * rise;
    // Without contrast the plates and furrows are of one colour.
    const float t = clamped(mix_of(0.55f + 0.25f * (lit - 0.5f), lit, contrast));
    Vec3 color = mix_of(dark, light, t);
    color *= 1 - 0.55f * contrast * (1 - smooth_step(0, 0.35f, here.height));  // the bottom of furrows sees no sky
    color += 0.018f * here.tint * here.height * Vec3(1, 0.35f, -0.3f);        // plates differ in hue
    return mix_of(color, 0.55f * dark, bark.band(u, v));
  });
}

}  // namespace espalier
