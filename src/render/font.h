#pragma once
// Font: printable ASCII as 5x7 dots in cells of 6x10 (two rows below the base line), for captions.

#include <cstdint>
#include <string>
#include <string_view>

#include "render/render.h"

namespace espalier {

inline constexpr std::uint32_t kCellWidth = 6, kCellHeight = 10;

/// Draws the text with the upper left corner of its first cell at (x, y), every dot `scale` pixels wide. What is not
/// printable ASCII becomes "?". Clipped at the picture's edges.
void draw_text(Picture& picture, std::int64_t x, std::int64_t y, std::string_view text, std::uint32_t scale,
               const std::uint8_t (&rgb)[3]);

/// The text, cut to `cells` characters with an ellipsis of dots where it is longer.
std::string fit_text(std::string_view text, std::size_t cells);

}  // namespace espalier
