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
  float clear = 1;                     // -1: developed already, with alpha
  Vec3 ghost_normal{0};
  float alpha = 1;
  Seen seen = Seen::backdrop;
};

/// Whether the samples see one surface, so that a few of them are enough.
bool is_plain(std::span<const Sample> samples);

Pixel develop_plain(std::span<const Sample> samples);
Pixel develop_mixed(const View& view, std::span<const Sample> samples);

class Film {
 public:
  Film(std::uint32_t width, std::uint32_t height, bool ghosts);

  /// Pixels may be put from several threads.
  void put(std::uint32_t x, std::uint32_t y, const Pixel& pixel);

  /// One pass over taps `step` pixels apart, 1, 2 or 4. Far ones count only where the light is all but the same: they
  /// take away the last mottles and leave shadows alone.
  void smooth_light(std::uint32_t step, Executor& executor);
  /// With alpha if the stage is clear.
  Picture develop(const View& view, Executor& executor) const;

 private:
  static constexpr std::uint32_t kBorder = 8;  // around the planes: what a tap may reach
  enum Plane { kNormal = 0, kPosition = 3, kLight = 6, kPlanes = 9 };

  std::size_t place(std::uint32_t x, std::uint32_t y) const { return x + kBorder + stride_ * (y + kBorder); }
  /// Four pixels from `at` on; the new light goes to `out`.
  void smooth_four(std::size_t at, std::ptrdiff_t step, float* const (&out)[3]) const;
  void develop_pixel(const View& view, std::uint32_t x, std::uint32_t y, Picture& picture) const;
  float ghost_change(std::uint32_t x, std::uint32_t y) const;
  /// What is left of a pixel once its planes are taken out.
  struct Rest {
    Vec3 albedo, extra;
    float alpha;
    Seen seen;
    bool developed;
  };
  /// Only where there are ghosts.
  struct Veil {
    Vec3 colour{0};
    float clear = 1;
    Vec3 normal{0};
  };

  std::uint32_t width_, height_;
  std::size_t stride_;
  std::vector<Rest> rests_;
  std::vector<Veil> veils_;  // empty: there are no ghosts
  std::vector<float> planes_[kPlanes];  // what is smoothed, and by what: component by component, with a border
};

}  // namespace espalier
