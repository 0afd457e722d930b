#include "render/film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "model/srgb.h"
#include "render/ghost.h"

namespace espalier {
namespace {

constexpr int kCurveSteps = 8192;

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
  p.clear = 0;
  for (const Sample& s : samples) {
    p.albedo += s.albedo, p.light += s.light, p.extra += s.extra;
    p.normal += s.normal, p.position += s.position;
    p.veil += s.veil, p.clear += s.clear, p.ghost_normal += s.ghost_normal;
  }
  const float share = 1 / static_cast<float>(samples.size());
  for (Vec3* v : {&p.albedo, &p.light, &p.extra, &p.normal, &p.position, &p.veil, &p.ghost_normal}) *v *= share;
  p.clear *= share;
  return p;
}

Pixel develop_mixed(std::span<const Sample> samples) {
  Pixel p;
  for (const Sample& s : samples) p.extra += colour_of(s), p.ghost_normal += s.ghost_normal;
  const float share = 1 / static_cast<float>(samples.size());
  p.extra *= share, p.ghost_normal *= share;
  p.clear = -1;  // developed already
  return p;
}

Vec3 Film::smoothed(std::uint32_t x, std::uint32_t y, int step) const {
  static constexpr float kKernel[3] = {0.375f, 0.25f, 0.0625f};
  const Pixel& centre = at(x, y);
  Vec3 sum(0);
  float weights = 0;
  for (int j = -2; j <= 2; ++j) {
    const int ty = static_cast<int>(y) + j * step;
    if (ty < 0 || ty >= static_cast<int>(height_)) continue;
    for (int i = -2; i <= 2; ++i) {
      const int tx = static_cast<int>(x) + i * step;
      if (tx < 0 || tx >= static_cast<int>(width_)) continue;
      const Pixel& tap = at(static_cast<std::uint32_t>(tx), static_cast<std::uint32_t>(ty));
      const float likeness = glm::dot(centre.normal, tap.normal);
      if (likeness <= 0.8f) continue;
      const float off_plane = glm::dot(centre.normal, tap.position - centre.position) * 150;
      const float l4 = likeness * likeness * likeness * likeness;
      const float weight = kKernel[std::abs(i)] * kKernel[std::abs(j)] * l4 * l4 / (1 + off_plane * off_plane);
      sum += weight * tap.light;
      weights += weight;
    }
  }
  return weights > 0 ? sum / weights : centre.light;
}

void Film::smooth_light(std::uint32_t step, Executor& executor) {
  std::vector<Vec3> light(pixels_.size());
  executor.for_each(height_, [&](std::size_t row, int) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < width_; ++x) {
      const Pixel& p = at(x, y);
      light[x + width_ * row] = p.normal == Vec3(0) ? p.light : smoothed(x, y, static_cast<int>(step));
    }
  });
  for (std::size_t i = 0; i < pixels_.size(); ++i) pixels_[i].light = light[i];
}

float Film::ghost_change(std::uint32_t x, std::uint32_t y) const {
  const std::uint32_t x0 = x > 0 ? x - 1 : x, x1 = x + 1 < width_ ? x + 1 : x;
  const std::uint32_t y0 = y > 0 ? y - 1 : y, y1 = y + 1 < height_ ? y + 1 : y;
  const Vec3 across = at(x1, y).ghost_normal - at(x0, y).ghost_normal;
  const Vec3 down = at(x, y1).ghost_normal - at(x, y0).ghost_normal;
  return std::sqrt(glm::dot(across, across) + glm::dot(down, down));
}

Picture Film::develop(Executor& executor) const {
  Picture picture{width_, height_, std::vector<std::uint8_t>(3 * pixels_.size())};
  executor.for_each(height_, [&](std::size_t row, int) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < width_; ++x) {
      const Pixel& p = at(x, y);
      const Vec3 base = p.clear < 0 ? p.extra : p.veil + p.clear * tone(p.albedo * p.light + p.extra);
      const Vec3 colour = ghost_edge(base, ghost_change(x, y));
      for (int c = 0; c < 3; ++c)
        picture.rgb[3 * (x + width_ * row) + static_cast<std::size_t>(c)] = developed(colour[c]);
    }
  });
  return picture;
}

}  // namespace espalier
