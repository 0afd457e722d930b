#include "render/sampling.h"

namespace espalier {

LightTables::LightTables() {
  for (std::uint32_t i = 0; i < kSize; ++i) {
    light_[i] = on_disc(PixelSamples::pair(i, 0xdb4f0b91u, 0xbbe05635u));
    lobe_[i] = on_disc(PixelSamples::pair(i, 0x91e10da6u, 0xa0f2ec76u));
    const Vec2 d = on_disc(PixelSamples::pair(i, 0xa0f2ec76u, 0x89e18286u));
    const float up2 = 1 - d.x * d.x - d.y * d.y;
    hemisphere_[i] = Vec3(d.x, d.y, up2 > 0 ? std::sqrt(up2) : 0.0f);
  }
}

const LightTables& LightTables::shared() {
  static const LightTables kTables;
  return kTables;
}

}  // namespace espalier
