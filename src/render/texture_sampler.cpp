#include "render/texture_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "grammar/surface_arguments.h"

namespace espalier {
namespace {

constexpr std::uint32_t kMostSide = 2048;

/// The two texels beside a coordinate in 0..1, and the share of the second.
struct Neighbours {
  std::uint32_t first, second;
  float share;
};
Neighbours neighbours(float x, std::uint32_t count) {
  x = (x - std::floor(x)) * static_cast<float>(count) - 0.5f;
  if (!(x >= 0)) x = x < 0 ? x + static_cast<float>(count) : 0;
  const auto first = std::min(static_cast<std::uint32_t>(x), count - 1);
  return {first, first + 1 < count ? first + 1 : 0, x - static_cast<float>(first)};
}

}  // namespace

TextureSampler::TextureSampler(const Image& image) {
  CHECK(image.width > 0 && image.height > 0);
  std::array<std::uint16_t, 256> linear;
  for (std::size_t i = 0; i < 256; ++i)
    linear[i] = static_cast<std::uint16_t>(65535 * linear_light(static_cast<int>(i)) + 0.5f);
  Level level{image.width, image.height, std::vector<std::uint16_t>(image.rgba.size())};
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    level.rgba[i] = i % 4 == 3 ? static_cast<std::uint16_t>(257 * image.rgba[i]) : linear[image.rgba[i]];
  while (level.width > kMostSide || level.height > kMostSide) level = halved(level);
  levels_.push_back(std::move(level));
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.back()));
}

TextureSampler::Level TextureSampler::halved(const Level& from) {
  Level to{std::max(from.width / 2, 1u), std::max(from.height / 2, 1u), {}};
  to.rgba.resize(std::size_t{4} * to.width * to.height);
  for (std::uint32_t y = 0; y < to.height; ++y) {
    for (std::uint32_t x = 0; x < to.width; ++x) {
      std::uint64_t sum[4] = {}, plain[3] = {};
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t sx = std::min(2 * x + k % 2, from.width - 1), sy = std::min(2 * y + k / 2, from.height - 1);
        const std::uint16_t* const p = from.rgba.data() + 4 * (sx + std::size_t{from.width} * sy);
        sum[3] += p[3];
        for (int c = 0; c < 3; ++c) sum[c] += std::uint64_t{p[c]} * p[3], plain[c] += p[c];
      }
      std::uint16_t* const out = to.rgba.data() + 4 * (x + std::size_t{to.width} * y);
      out[3] = static_cast<std::uint16_t>(sum[3] / 4);
      for (int c = 0; c < 3; ++c)
        out[c] = static_cast<std::uint16_t>(sum[3] > 0 ? sum[c] / sum[3] : plain[c] / 4);
    }
  }
  return to;
}

TextureSampler::Texel TextureSampler::at(const Vec2& uv, float footprint) const {
  std::size_t number = 0;
  float texels = footprint * static_cast<float>(std::max(levels_[0].width, levels_[0].height));
  for (; texels > 1.5f && number + 1 < levels_.size(); texels *= 0.5f) ++number;
  const Level& level = levels_[number];
  const Neighbours x = neighbours(uv.x, level.width), y = neighbours(1 - uv.y, level.height);
  Texel out{Vec3(0), 0};
  for (int k = 0; k < 4; ++k) {
    const std::uint32_t px = k % 2 ? x.second : x.first, py = k / 2 ? y.second : y.first;
    const float weight = (k % 2 ? x.share : 1 - x.share) * (k / 2 ? y.share : 1 - y.share) / 65535;
    const std::uint16_t* const p = level.rgba.data() + 4 * (px + std::size_t{level.width} * py);
    out.color += weight * Vec3(p[0], p[1], p[2]);
    out.alpha += weight * static_cast<float>(p[3]);
  }
  return out;
}

}  // namespace espalier
