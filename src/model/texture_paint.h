#pragma once
// What the kinds of textures share: colours mixed as the eye sees them (in sRGB), and the loop over pixels.

#include "model/image.h"
#include "model/srgb.h"
#include "model/texture_noise.h"

namespace espalier {

/// sRGB in 0..1 of a linear colour.
inline Vec3 perceived(const Vec3& linear) {
  return {static_cast<float>(srgb_from_linear(linear.x)), static_cast<float>(srgb_from_linear(linear.y)),
          static_cast<float>(srgb_from_linear(linear.z))};
}

inline std::uint8_t byte_of(float x) { return static_cast<std::uint8_t>(255 * clamped(x) + 0.5f); }

/// Calls paint(u, v) at pixel centres, u to the right and v upwards in 0..1, which gives sRGB and alpha.
template <typename Paint>
Image paint_image(std::uint32_t size, const Paint& paint) {
  Image image{size, size, std::vector<std::uint8_t>(std::size_t{4} * size * size)};
  const float step = 1 / static_cast<float>(size);
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      float alpha = 1;
      const Vec3 color =
          paint((static_cast<float>(x) + 0.5f) * step, 1 - (static_cast<float>(y) + 0.5f) * step, alpha);
      std::uint8_t* const out = image.pixel(x, y);
      for (int c = 0; c < 3; ++c) out[c] = byte_of(color[c]);
      out[3] = byte_of(alpha);
    }
  }
  return image;
}

}  // namespace espalier
