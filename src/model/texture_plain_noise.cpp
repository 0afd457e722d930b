// Noise between two colours: clouds, stone, marble (warped ridges), wood (stretched).

#include <algorithm>
#include <cmath>

#include "model/texture.h"
#include "model/texture_paint.h"

namespace espalier {

Image make_noise(const TextureRef& texture, std::uint32_t size) {
  const Vec3 a = perceived(texture.colors[0]), b = perceived(texture.colors[1]);
  const float cells = std::floor(texture_number(texture, "cells") + 0.5f);
  // As many cells upwards as across, or fewer of them: streaks.
  const float up = std::max(1.0f, std::floor(cells / texture_number(texture, "stretch") + 0.5f));
  const Periods periods{static_cast<std::int32_t>(cells), static_cast<std::int32_t>(up)};
  const int octaves = static_cast<int>(texture_number(texture, "octaves") + 0.5f);
  const float contrast = texture_number(texture, "contrast"), warp = 1.2f * texture_number(texture, "warp");
  const float ridges = texture_number(texture, "ridges");
  const auto seed = 64 * static_cast<std::uint32_t>(texture_number(texture, "seed"));
  // Contrast 0.5 shows the noise as it is, 1 as two colours with a narrow border.
  const float steepness = 0.5f * contrast / std::max(1.02f - contrast, 0.02f);
  return paint_image(size, [&](float u, float v, float&) {
    Vec2 p(u * cells, v * up);
    if (warp > 0) {
      const float wx = fractal_noise(p, periods, 3, seed + 16), wy = fractal_noise(p, periods, 3, seed + 32);
      p += warp * Vec2(wx, wy);
    }
    const float n = fractal_noise(p, periods, octaves, seed, ridges);
    return mix_of(a, b, clamped(0.5f + n * steepness));
  });
}

}  // namespace espalier
