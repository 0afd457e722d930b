#pragma once
// Paint: plain drawing on pictures: boxes, lines, other pictures. Whole pixels, clipped at the edges.

#include <cstdint>
#include <string>

#include "render/render.h"

namespace espalier {

/// 8-bit sRGB.
struct Colour {
  std::uint8_t rgb[3];

  bool operator==(const Colour&) const = default;
};

/// Of sheets.
inline constexpr Colour kPaper{{246, 246, 244}}, kInk{{40, 42, 46}}, kFrame{{205, 206, 208}};
inline constexpr Colour kFaintInk{{112, 116, 122}};

/// `part` of 256 of the way from a to b.
constexpr Colour mix(const Colour& a, const Colour& b, std::uint32_t part) {
  Colour out{};
  for (int c = 0; c < 3; ++c)
    out.rgb[c] = static_cast<std::uint8_t>((a.rgb[c] * (256 - part) + b.rgb[c] * part + 128) / 256);
  return out;
}

/// "#1f5fd0".
std::string hex_of(const Colour& colour);

Picture blank(std::uint32_t width, std::uint32_t height, const Colour& colour);
void set_pixel(Picture& picture, std::int64_t x, std::int64_t y, const Colour& colour);
void fill_box(Picture& picture, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
              const Colour& colour);
/// The pixels just outside of a box.
void draw_frame(Picture& picture, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
                const Colour& colour);
void paste(Picture& onto, const Picture& picture, std::int64_t x, std::int64_t y);
/// One pixel wide.
void draw_line(Picture& picture, std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1,
               const Colour& colour);

}  // namespace espalier
