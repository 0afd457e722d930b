#pragma once
// What the readers of image files share.

#include <cstdint>

namespace espalier {

/// Throws Error (naming no file) for no pixels, or more than Image allows.
void check_image_size(std::uint64_t width, std::uint64_t height);

/// Rec. 709, exact where all three are equal.
inline float luma(float red, float green, float blue) {
  if (red == green && green == blue) return red;
  return 0.2126f * red + 0.7152f * green + 0.0722f * blue;
}

}  // namespace espalier
