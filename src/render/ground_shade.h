#pragma once
// GroundShade: where on the ground a part may hide some of the key light, so that rays elsewhere need not look for one.

#include <cstdint>
#include <vector>

#include "render/stage.h"
#include "render/tracer.h"

namespace espalier {

class GroundShade {
 public:
  GroundShade(const Stage& stage, const Tracer& tracer);

  /// False: the whole key light reaches this point of the ground.
  bool may_hide(const Vec3& p) const {
    const float x = (p.x + kReach) * kCellsPerLength, z = (p.z + kReach) * kCellsPerLength;
    if (!(x >= 0 && x < kSide && z >= 0 && z < kSide)) return true;
    return marked_[static_cast<std::size_t>(x) + kSide * static_cast<std::size_t>(z)] != 0;
  }

 private:
  static constexpr int kSide = 256;
  static constexpr float kReach = 6.5f;  // the ground ends before
  static constexpr float kCellsPerLength = kSide / (2 * kReach);

  void add(const Stage& stage, const Placed& part);

  std::vector<std::uint8_t> marked_;
};

}  // namespace espalier
