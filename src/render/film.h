#pragma once
// Film: the pixels while a picture is made. Pixels that see one surface keep light apart from colour; the light is
// smoothed over neighbours on the same plane (edge-avoiding a-trous wavelets, Dammertz et al. 2010), then all is
// developed to 8-bit sRGB.

#include <cstdint>
#include <span>
#include <vector>

#include "base/executor.h"
#include "render/render.h"
#include "render/shade.h"

namespace espalier {

struct Pixel {
  Vec3 albedo{0}, light{0}, extra{0};  // means; pixels of several surfaces have all in `extra`, developed
  Vec3 normal{0}, position{0};         // 0 where the light is not to be smoothed
  Vec3 veil{0};
  float clear = 1;
  Vec3 ghost_normal{0};
};

/// Whether the samples see one surface, so that a few of them are enough.
bool is_plain(std::span<const Sample> samples);

Pixel develop_plain(std::span<const Sample> samples);
Pixel develop_mixed(std::span<const Sample> samples);

class Film {
 public:
  Film(std::uint32_t width, std::uint32_t height)
      : width_(width), height_(height), pixels_(std::size_t{width} * height) {}

  Pixel& at(std::uint32_t x, std::uint32_t y) { return pixels_[x + std::size_t{width_} * y]; }
  const Pixel& at(std::uint32_t x, std::uint32_t y) const { return pixels_[x + std::size_t{width_} * y]; }

  /// One pass over taps `step` pixels apart.
  void smooth_light(std::uint32_t step, Executor& executor);
  Picture develop(Executor& executor) const;

 private:
  Vec3 smoothed(std::uint32_t x, std::uint32_t y, int step) const;
  float ghost_change(std::uint32_t x, std::uint32_t y) const;

  std::uint32_t width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace espalier
