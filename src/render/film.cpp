#include "render/film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "model/srgb.h"
#include "render/float4.h"
#include "render/ghost.h"

namespace espalier {
namespace {

constexpr int kCurveSteps = 8192;
constexpr float kChangeScale = 12;  // of the sum of three channels: a change of light of 3 % halves a far tap's weight

/// 8-bit sRGB of a linear value by a table, fine enough that every byte has several entries.
std::uint8_t developed(float linear) {
  static const std::array<std::uint8_t, kCurveSteps + 1> kCurve = [] {
    std::array<std::uint8_t, kCurveSteps + 1> curve;
    for (int i = 0; i <= kCurveSteps; ++i) curve[i] = srgb_byte(static_cast<double>(i) / kCurveSteps);
    return curve;
  }();
  if (!(linear > 0)) return 0;
  return kCurve[static_cast<std::size_t>(std::min(linear, 1.0f) * kCurveSteps + 0.5f)];
}

}  // namespace

bool is_plain(std::span<const Sample> samples) {
  const Sample& first = samples[0];
  for (const Sample& s : samples) {
    if (s.layered || s.surface != first.surface ||
        glm::dot(s.normal, first.normal) < 0.9f * glm::dot(first.normal, first.normal)) {
      return false;
    }
    // A ghost's outline crosses the pixel.
    if (glm::dot(s.ghost_normal - first.ghost_normal, s.ghost_normal - first.ghost_normal) > 0.05f) return false;
  }
  return true;
}

Pixel develop_plain(std::span<const Sample> samples) {
  Pixel p;
  p.clear = p.alpha = 0;
  p.seen = samples[0].seen;
  for (const Sample& s : samples) {
    p.albedo += s.albedo, p.light += s.light, p.extra += s.extra;
    p.normal += s.normal, p.position += s.position;
    p.veil += s.veil, p.clear += s.clear, p.ghost_normal += s.ghost_normal;
    p.alpha += s.alpha;
  }
  const float share = 1 / static_cast<float>(samples.size());
  for (Vec3* v : {&p.albedo, &p.light, &p.extra, &p.normal, &p.position, &p.veil, &p.ghost_normal}) *v *= share;
  p.clear *= share, p.alpha *= share;
  return p;
}

Pixel develop_mixed(const View& view, std::span<const Sample> samples) {
  Pixel p;
  p.alpha = 0;
  for (const Sample& s : samples)
    p.extra += colour_of(s), p.alpha += alpha_of(view, s), p.ghost_normal += s.ghost_normal;
  const float share = 1 / static_cast<float>(samples.size());
  p.extra *= share, p.alpha *= share, p.ghost_normal *= share;
  p.clear = -1;
  return p;
}

Film::Film(std::uint32_t width, std::uint32_t height, bool ghosts)
    : width_(width),
      height_(height),
      stride_((width + 2 * kBorder + 3) / 4 * 4),
      rests_(std::size_t{width} * height),
      veils_(ghosts ? rests_.size() : 0) {
  // A vector may reach beyond the last pixel.
  for (std::vector<float>& plane : planes_) plane.resize(stride_ * (height + 2 * kBorder) + 8);
}

void Film::put(std::uint32_t x, std::uint32_t y, const Pixel& pixel) {
  const std::size_t i = x + std::size_t{width_} * y;
  rests_[i] = {pixel.albedo, pixel.extra, pixel.alpha, pixel.seen, pixel.clear < 0};
  if (!veils_.empty()) veils_[i] = {pixel.veil, pixel.clear, pixel.ghost_normal};
  const std::size_t p = place(x, y);
  for (int c = 0; c < 3; ++c) {
    planes_[kNormal + c][p] = pixel.normal[c];
    planes_[kPosition + c][p] = pixel.position[c];
    planes_[kLight + c][p] = pixel.light[c];
  }
}

void Film::smooth_four(std::size_t at, std::ptrdiff_t step, float* const (&out)[3]) const {
  static constexpr float kKernel[3] = {0.375f, 0.25f, 0.0625f};
  const auto load = [&](int plane, std::ptrdiff_t offset) {
    return Float4::load_any(planes_[plane].data() + static_cast<std::ptrdiff_t>(at) + offset);
  };
  const Float4 n[3] = {load(kNormal, 0), load(kNormal + 1, 0), load(kNormal + 2, 0)};
  const Float4 p[3] = {load(kPosition, 0), load(kPosition + 1, 0), load(kPosition + 2, 0)};
  const Float4 old[3] = {load(kLight, 0), load(kLight + 1, 0), load(kLight + 2, 0)};
  if (!any(at_least(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], Float4(1e-6f)))) {
    alignas(16) float same[4];
    for (int c = 0; c < 3; ++c) old[c].store(same), std::copy_n(same, 4, out[c]);
    return;
  }
  const float change_scale = step > 2 ? kChangeScale : 0;
  Float4 sum[3] = {Float4(0), Float4(0), Float4(0)}, weights(0);
  for (int j = -2; j <= 2; ++j) {
    for (int i = -2; i <= 2; ++i) {
      const std::ptrdiff_t tap = step * (i + j * static_cast<std::ptrdiff_t>(stride_));
      const Float4 likeness = n[0] * load(kNormal, tap) + n[1] * load(kNormal + 1, tap) + n[2] * load(kNormal + 2, tap);
      const Float4 like = at_least(likeness, Float4(0.8f));
      if (!any(like)) continue;
      const Float4 off_plane = (n[0] * (load(kPosition, tap) - p[0]) + n[1] * (load(kPosition + 1, tap) - p[1]) +
                                n[2] * (load(kPosition + 2, tap) - p[2])) * Float4(150);
      const Float4 l2 = likeness * likeness, l4 = l2 * l2;
      const Float4 light[3] = {load(kLight, tap), load(kLight + 1, tap), load(kLight + 2, tap)};
      const Float4 change = (light[0] - old[0] + (light[1] - old[1]) + (light[2] - old[2])) * Float4(change_scale);
      const Float4 weight = where(like, Float4(kKernel[std::abs(i)] * kKernel[std::abs(j)]) * l4 * l4 /
                                            (Float4(1) + off_plane * off_plane + change * change));
      for (int c = 0; c < 3; ++c) sum[c] = sum[c] + weight * light[c];
      weights = weights + weight;
    }
  }
  alignas(16) float total[4], lights[3][4], olds[3][4];
  weights.store(total);
  for (int c = 0; c < 3; ++c) (sum[c] / weights).store(lights[c]), old[c].store(olds[c]);
  for (int k = 0; k < 4; ++k) {
    for (int c = 0; c < 3; ++c) out[c][k] = total[k] > 0 ? lights[c][k] : olds[c][k];
  }
}

void Film::smooth_light(std::uint32_t step, Executor& executor) {
  CHECK(2 * step <= kBorder);
  std::vector<float> smoothed[3];
  for (std::vector<float>& plane : smoothed) plane.resize(planes_[kLight].size());
  executor.for_each(height_, [&](std::size_t row, int) {
    for (std::uint32_t x = 0; x < width_; x += 4) {
      const std::size_t p = place(x, static_cast<std::uint32_t>(row));
      smooth_four(p, step, {smoothed[0].data() + p, smoothed[1].data() + p, smoothed[2].data() + p});
    }
  });
  for (int c = 0; c < 3; ++c) planes_[kLight + c].swap(smoothed[c]);
}

float Film::ghost_change(std::uint32_t x, std::uint32_t y) const {
  const std::uint32_t x0 = x > 0 ? x - 1 : x, x1 = x + 1 < width_ ? x + 1 : x;
  const std::uint32_t y0 = y > 0 ? y - 1 : y, y1 = y + 1 < height_ ? y + 1 : y;
  const auto normal = [&](std::uint32_t px, std::uint32_t py) { return veils_[px + std::size_t{width_} * py].normal; };
  const Vec3 across = normal(x1, y) - normal(x0, y), down = normal(x, y1) - normal(x, y0);
  return std::sqrt(glm::dot(across, across) + glm::dot(down, down));
}

void Film::develop_pixel(const View& view, std::uint32_t x, std::uint32_t y, Picture& picture) const {
  const std::size_t plane = place(x, y), i = x + std::size_t{width_} * y;
  const Rest& p = rests_[i];
  Vec3 colour = p.extra;
  float alpha = p.alpha;
  if (!p.developed) {
    const Vec3 light(planes_[kLight][plane], planes_[kLight + 1][plane], planes_[kLight + 2][plane]);
    const Vec3 base = p.albedo * light + p.extra;
    colour = p.seen == Seen::model ? tone(base) : base;
    if (view.stage.clear && p.seen == Seen::ground) alpha = shadow_alpha(light);
  }
  if (!veils_.empty()) {
    const Veil& veil = veils_[i];
    if (!p.developed) colour = veil.colour + veil.clear * colour, alpha = 1 - veil.clear * (1 - alpha);
    const float change = ghost_change(x, y);
    alpha = std::max(alpha, ghost_edge(Vec3(0), Vec3(1), change).x);
    colour = ghost_edge(colour, kGhostEdge, change);
  }
  if (view.stage.clear) {
    picture.alpha[i] = static_cast<std::uint8_t>(255 * std::clamp(alpha, 0.0f, 1.0f) + 0.5f);
    colour = picture.alpha[i] > 0 ? colour / alpha : Vec3(0);
  }
  for (int c = 0; c < 3; ++c) picture.rgb[3 * i + static_cast<std::size_t>(c)] = developed(colour[c]);
}

Picture Film::develop(const View& view, Executor& executor) const {
  Picture picture{width_, height_, std::vector<std::uint8_t>(3 * rests_.size()), {}};
  if (view.stage.clear) picture.alpha.resize(rests_.size());
  executor.for_each(height_, [&](std::size_t row, int) {
    for (std::uint32_t x = 0; x < width_; ++x) develop_pixel(view, x, static_cast<std::uint32_t>(row), picture);
  });
  return picture;
}

}  // namespace espalier
