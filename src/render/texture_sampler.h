#pragma once
// TextureSampler: a texture at any point and size: bilinear, repeating, with halved copies of the picture for what is
// small or far. Linear light. Exact arithmetic: the same bits on every CPU.

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "model/image.h"

namespace espalier {

class TextureSampler {
 public:
  /// Pictures wider or higher than 2048 are halved first.
  explicit TextureSampler(const Image& image);

  struct Texel {
    Vec3 color{0};
    float alpha = 1;
  };
  /// At a point (uv.h); `footprint` is the side of the area that counts, as a share of the picture's.
  Texel at(const Vec2& uv, float footprint = 0) const;

 private:
  struct Level {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint16_t> rgba;  // linear, 0..65535, alpha not multiplied in
  };
  static Level halved(const Level& from);

  std::vector<Level> levels_;  // each of half the size of the one before, down to one pixel
};

/// Where a cut-out surface is: what the tracer asks at each hit.
struct Cutout {
  const TextureSampler* texture = nullptr;
  Vec2 repeats{1};
  float least_alpha = 0.5f;

  bool shows(const Vec2& uv) const { return texture->at(uv * repeats).alpha >= least_alpha; }
};

}  // namespace espalier
