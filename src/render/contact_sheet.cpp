#include <algorithm>
#include <cmath>

#include "render/font.h"
#include "render/render.h"

namespace espalier {
namespace {

constexpr std::uint32_t kGap = 16;           // between cells and around them
constexpr std::uint32_t kCaption = 32;       // height below a picture
constexpr std::uint32_t kTitle = 56;         // height above all cells
constexpr std::uint32_t kTitleScale = 3, kCaptionScale = 2;
constexpr std::uint32_t kSmallestCell = 160;  // so that captions have room
constexpr std::uint8_t kPaper[3] = {246, 246, 244}, kInk[3] = {40, 42, 46}, kFrame[3] = {205, 206, 208};

struct Layout {
  std::uint32_t columns, rows, cell_width, cell_height;  // of a cell, its caption included
  std::uint32_t width() const { return kGap + columns * (cell_width + kGap); }
  std::uint32_t height() const { return kTitle + rows * (cell_height + kGap); }
};

/// So many columns; 0 = those whose sheet is nearest to 4:3, the fewer on a tie.
Layout arrange(std::size_t count, std::uint32_t wanted, std::uint32_t cell_width, std::uint32_t cell_height) {
  Layout best{1, 1, cell_width, cell_height};
  double least = 1e30;
  const std::size_t first = std::max(wanted, 1u), last = wanted ? wanted : std::max<std::size_t>(count, 1);
  for (std::size_t columns = first; columns <= last; ++columns) {
    const std::size_t rows = (count + columns - 1) / columns;
    const Layout layout{static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), cell_width, cell_height};
    const double ratio = layout.width() * 3.0 / (layout.height() * 4.0);
    const double off = std::max(ratio, 1 / ratio);
    if (off < least) least = off, best = layout;
  }
  return best;
}

void fill(Picture& sheet, std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
          const std::uint8_t (&rgb)[3]) {
  for (std::uint32_t row = y; row < y + height; ++row) {
    for (std::uint32_t column = x; column < x + width; ++column) {
      std::copy(rgb, rgb + 3,
                sheet.rgb.begin() + static_cast<std::ptrdiff_t>(3 * (column + std::size_t{sheet.width} * row)));
    }
  }
}

void paste(Picture& sheet, const Picture& picture, std::uint32_t x, std::uint32_t y) {
  for (std::uint32_t row = 0; row < picture.height; ++row) {
    const auto from = picture.rgb.begin() + static_cast<std::ptrdiff_t>(std::size_t{3} * picture.width * row);
    std::copy(from, from + static_cast<std::ptrdiff_t>(3 * picture.width),
              sheet.rgb.begin() + static_cast<std::ptrdiff_t>(3 * (x + std::size_t{sheet.width} * (y + row))));
  }
}

}  // namespace

Picture contact_sheet(const std::vector<SheetCell>& cells, const std::string& title, std::uint32_t columns) {
  std::uint32_t picture_width = kSmallestCell, picture_height = 1;
  for (const SheetCell& cell : cells) {
    picture_width = std::max(picture_width, cell.picture.width);
    picture_height = std::max(picture_height, cell.picture.height);
  }
  const Layout layout = arrange(cells.size(), columns, picture_width, picture_height + kCaption);
  Picture sheet{layout.width(), layout.height(), {}};
  sheet.rgb.resize(std::size_t{3} * sheet.width * sheet.height);
  fill(sheet, 0, 0, sheet.width, sheet.height, kPaper);
  draw_text(sheet, kGap, (kTitle - 7 * kTitleScale) / 2,
            fit_text(title, (sheet.width - 2 * kGap) / (kCellWidth * kTitleScale)), kTitleScale, kInk);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Picture& picture = cells[i].picture;
    const auto column = static_cast<std::uint32_t>(i % layout.columns),
               row = static_cast<std::uint32_t>(i / layout.columns);
    const std::uint32_t left = kGap + column * (layout.cell_width + kGap),
                        top = kTitle + row * (layout.cell_height + kGap);
    // Smaller pictures stand in the middle of their cell.
    const std::uint32_t x = left + (picture_width - picture.width) / 2, y = top + (picture_height - picture.height) / 2;
    fill(sheet, x - 1, y - 1, picture.width + 2, picture.height + 2, kFrame);
    paste(sheet, picture, x, y);
    const std::string caption = fit_text(cells[i].caption, layout.cell_width / (kCellWidth * kCaptionScale));
    draw_text(sheet, left, top + picture_height + (kCaption - 7 * kCaptionScale) / 2, caption, kCaptionScale, kInk);
  }
  return sheet;
}

}  // namespace espalier
