#pragma once
// Coverage: which tiles of a picture the parts of a tracer may appear in, so that rays elsewhere need not look for
// them.

#include <cstdint>
#include <vector>

#include "render/camera.h"
#include "render/tracer.h"

namespace espalier {

class Coverage {
 public:
  Coverage(const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// Marks every tile that a part's box may reach.
  void add(const Tracer& tracer);
  /// False: no ray through the pixel meets anything that was added.
  bool may_show(std::uint32_t x, std::uint32_t y) const { return marked_[x / kTile + columns_ * (y / kTile)] != 0; }

 private:
  static constexpr std::uint32_t kTile = 8;
  void add(const Placed& part);

  Camera camera_;
  std::uint32_t width_, height_;
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace espalier
