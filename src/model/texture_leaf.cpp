// A leaf, its stem at the middle of the lower edge and its tip at the upper: outline, midrib and side veins, the blade
// between them vaulted, autumn from the margin inwards. Outside it is transparent.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "model/texture.h"
#include "model/texture_paint.h"

namespace espalier {
namespace {

constexpr float kBladeFrom = 0.09f, kBladeTo = 0.985f;

class LeafShape {
 public:
  explicit LeafShape(const TextureRef& texture)
      : width_(0.49f * texture_number(texture, "width")),
        fall_(0.55f + 1.0f * texture_number(texture, "tip")),
        teeth_(texture_number(texture, "teeth")),
        lobes_(texture_number(texture, "lobes")),
        veins_(std::floor(texture_number(texture, "veins") + 0.5f)) {
    const float peak = 0.55f / (0.55f + fall_);
    scale_ = width_ / bulge(peak);
  }

  /// Half the blade's width at a share t of its length, as seen from a point that is x from the midrib.
  float half_width(float t, float x) const {
    if (!(t > 0 && t < 1)) return 0;
    const float along = vein_place(t, x) * veins_;
    float w = scale_ * bulge(t);
    if (lobes_ > 0) {
      // Bays between the veins' ends, deepest in the middle of the leaf.
      const float wave = 0.5f - 0.5f * cosine(static_cast<float>(2 * kPi) * (0.5f * along));
      w *= 1 - 0.62f * lobes_ * wave * smooth_step(0, 0.2f, t) * (1 - smooth_step(0.8f, 1, t));
    }
    const float notch = 3 * along, tooth = notch - std::floor(notch);  // points towards the tip
    return w * (1 - 0.16f * teeth_ * (1 - tooth)) + 0.012f * teeth_ * (tooth - 0.5f);
  }

  /// Where on the midrib the line that runs as side veins do begins, for a point: veins rise outwards, and bend up.
  float vein_place(float t, float x) const {
    const float out = std::abs(x);
    return t - 0.62f * out - 0.5f * out * out / (width_ + 0.1f);
  }

  bool inside(float u, float v) const {
    const float x = u - 0.5f, t = (v - kBladeFrom) / (kBladeTo - kBladeFrom);
    if (std::abs(x) < half_width(t, x)) return true;
    // The stem, wider at its foot. It ends short of the edge, so that nothing shows up at the opposite one.
    return v > 0.012f && v < kBladeFrom + 0.05f && std::abs(x) < 0.009f + 0.008f * (1 - v / kBladeFrom);
  }

  float veins() const { return veins_; }
  float width() const { return width_; }

 private:
  float bulge(float t) const { return power(t, 0.55f) * power(1 - t, fall_); }

  float width_, fall_, teeth_, lobes_, veins_;
  float scale_ = 1;
};

/// The share of a pixel that the leaf covers, from 4 x 4 places in it.
float coverage(const LeafShape& shape, float u, float v, float pixel) {
  int covered = 0;
  for (int k = 0; k < 16; ++k) {
    const float du = (static_cast<float>(k % 4) - 1.5f) / 4, dv = (static_cast<float>(k / 4) - 1.5f) / 4;
    covered += shape.inside(u + du * pixel, v + dv * pixel);
  }
  return static_cast<float>(covered) / 16;
}

/// Side veins at a point: how near the next one is (0 on it, 1 midway), and its half width there in the same measure.
struct SideVein {
  float away, thick;
};
SideVein side_vein(const LeafShape& shape, float t, float x) {
  const float side = x < 0 ? 0.35f : 0.0f;  // the two sides alternate
  const float along = shape.vein_place(t, x) * shape.veins() + side;
  const float phase = along - std::floor(along);
  const float out = clamped(std::abs(x) / std::max(shape.half_width(t, x), 1e-3f));
  return {2 * std::abs(phase - 0.5f) > 0 ? 1 - 2 * std::abs(phase - 0.5f) : 1, 0.11f * (1 - 0.75f * out)};
}

}  // namespace

Image make_leaf_picture(const TextureRef& texture, std::uint32_t size) {
  const LeafShape shape(texture);
  const Vec3 green = perceived(texture.colors[0]), vein = perceived(texture.colors[1]);
  const float wilt = texture_number(texture, "wilt"), pixel = 1 / static_cast<float>(size);
  const auto seed = 64 * static_cast<std::uint32_t>(texture_number(texture, "seed"));
  return paint_image(size, [&](float u, float v, float& alpha) {
    alpha = coverage(shape, u, v, pixel);
    // Outside, the colour of the margin goes on, so that filters mix in nothing foreign.
    const float t = std::clamp((v - kBladeFrom) / (kBladeTo - kBladeFrom), 0.0f, 0.995f);
    const float half = std::max(shape.half_width(t, u - 0.5f), 0.004f);
    const float x = std::clamp(u - 0.5f, -half, half), out = std::abs(x) / half;

    const float blotches = fractal_noise({5 * u, 5 * v}, {8, 8}, 4, seed);
    const float grain = fractal_noise({60 * u, 60 * v}, {64, 64}, 3, seed + 8);
    const float net = 1 - std::abs(fractal_noise({22 * u, 22 * v}, {32, 32}, 2, seed + 16));
    const SideVein side = side_vein(shape, t, x);
    const float vault = smooth_step(0, 0.8f, side.away);  // the blade rises between the veins
    float shade = 0.80f + 0.24f * vault + 0.10f * blotches + 0.05f * grain - 0.10f * out;
    shade *= x < 0 ? 1.05f : 0.95f;  // the two halves are tilted
    Vec3 color = green * shade;
    color = mix_of(color, vein, 0.10f * smooth_step(0.86f, 1, net));

    const float rib_half = 0.012f * (1 - 0.75f * t) + 0.002f;
    const float rib = 1 - smooth_step(0.6f * rib_half, 1.5f * rib_half, std::abs(x));
    const float branch = 1 - smooth_step(0.5f * side.thick, 1.3f * side.thick, side.away);
    if (wilt > 0) {
      // Yellow, then brown, from the margin and from spots inwards; along the veins the green stays longest.
      const float age = 1.5f * wilt - 0.5f + 0.45f * out * out + 0.30f * blotches - 0.30f * (1 - vault);
      const Vec3 yellow(0.80f, 0.62f, 0.18f), brown(0.42f, 0.25f, 0.11f);
      color = mix_of(color, yellow * shade, smooth_step(-0.15f, 0.35f, age));
      color = mix_of(color, brown * shade, smooth_step(0.35f, 0.95f, age));
    }
    color = mix_of(color, vein * (0.92f + 0.08f * vault), 0.75f * std::max(rib, 0.65f * branch));
    const bool stem = v < kBladeFrom;
    return stem ? mix_of(green, vein, 0.6f) * (0.9f - 4 * std::abs(u - 0.5f)) : color;
  });
}

}  // namespace espalier
