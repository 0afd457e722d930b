#pragma once
// Camera: a pinhole that looks at a set of points from a given side, as near as it can with all of them in the picture.

#include <cstdint>
#include <span>

#include "base/vec.h"

namespace espalier {

struct Camera {
  Vec3 eye{0, 0, 5};
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // unit
  float tan_x = 0.3f, tan_y = 0.25f;                    // of half the angles of view

  /// The unit direction through the picture point (x, y) in [-1, 1], y upwards.
  Vec3 direction(float x, float y) const;
};

/// `margin` is the share of the picture left free at each side; the angle of view is that of a long lens.
Camera frame_points(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, std::uint32_t width,
                    std::uint32_t height, float margin);

}  // namespace espalier
