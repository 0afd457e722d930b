#include "render/paint.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace espalier {

std::string hex_of(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.rgb[0], colour.rgb[1], colour.rgb[2]);
}

Picture blank(std::uint32_t width, std::uint32_t height, const Colour& colour) {
  Picture picture{width, height, {}};
  picture.rgb.resize(std::size_t{3} * width * height);
  fill_box(picture, 0, 0, width, height, colour);
  return picture;
}

void set_pixel(Picture& picture, std::int64_t x, std::int64_t y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  std::copy(colour.rgb, colour.rgb + 3, picture.rgb.data() + 3 * (x + y * picture.width));
}

void fill_box(Picture& picture, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
              const Colour& colour) {
  const std::int64_t right = std::min<std::int64_t>(x + width, picture.width);
  const std::int64_t bottom = std::min<std::int64_t>(y + height, picture.height);
  for (std::int64_t row = std::max<std::int64_t>(y, 0); row < bottom; ++row)
    for (std::int64_t column = std::max<std::int64_t>(x, 0); column < right; ++column)
      set_pixel(picture, column, row, colour);
}

void draw_frame(Picture& picture, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
                const Colour& colour) {
  fill_box(picture, x - 1, y - 1, width + 2, 1, colour);
  fill_box(picture, x - 1, y + height, width + 2, 1, colour);
  fill_box(picture, x - 1, y, 1, height, colour);
  fill_box(picture, x + width, y, 1, height, colour);
}

void paste(Picture& onto, const Picture& picture, std::int64_t x, std::int64_t y) {
  const std::int64_t first = std::max<std::int64_t>(0, -x);
  const std::int64_t last = std::min<std::int64_t>(picture.width, onto.width - x);
  if (first >= last) return;
  for (std::int64_t row = std::max<std::int64_t>(0, -y); row < picture.height && y + row < onto.height; ++row) {
    const std::uint8_t* from = picture.rgb.data() + 3 * (first + row * picture.width);
    std::copy(from, from + 3 * (last - first), onto.rgb.data() + 3 * (x + first + (y + row) * onto.width));
  }
}

// Bresenham's, with the error counted for both axes at once.
void draw_line(Picture& picture, std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1,
               const Colour& colour) {
  const std::int64_t dx = std::abs(x1 - x0), dy = -std::abs(y1 - y0);
  const int step_x = x0 < x1 ? 1 : -1, step_y = y0 < y1 ? 1 : -1;
  for (std::int64_t error = dx + dy;;) {
    set_pixel(picture, x0, y0, colour);
    if (x0 == x1 && y0 == y1) return;
    const std::int64_t twice = 2 * error;
    if (twice >= dy) error += dy, x0 += step_x;
    if (twice <= dx) error += dx, y0 += step_y;
  }
}

}  // namespace espalier
