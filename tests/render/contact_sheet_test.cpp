#include <set>

#include <gtest/gtest.h>

#include "render/font.h"
#include "render/test_scenes.h"

namespace espalier {
namespace {

Picture plain(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, value)};
}

/// Whether the sheet holds the picture, pixel for pixel.
bool holds(const Picture& sheet, const Picture& picture) {
  for (std::uint32_t y0 = 0; y0 + picture.height <= sheet.height; ++y0) {
    for (std::uint32_t x0 = 0; x0 + picture.width <= sheet.width; ++x0) {
      bool equal = true;
      for (std::uint32_t y = 0; y < picture.height && equal; ++y) {
        equal = std::equal(pixel(picture, 0, y), pixel(picture, 0, y) + 3 * picture.width, pixel(sheet, x0, y0 + y));
      }
      if (equal) return true;
    }
  }
  return false;
}

std::size_t dark_pixels(const Picture& p, std::uint32_t top, std::uint32_t bottom) {
  std::size_t n = 0;
  for (std::uint32_t y = top; y < bottom; ++y) {
    for (std::uint32_t x = 0; x < p.width; ++x) n += pixel(p, x, y)[0] < 100;
  }
  return n;
}

TEST(ContactSheet, ShowsEveryPictureWhole) {
  std::vector<SheetCell> cells;
  for (int i = 0; i < 7; ++i) {
    cells.push_back({plain(200, 150, static_cast<std::uint8_t>(110 + 10 * i)), "cell " + std::to_string(i)});
  }
  cells[3].picture = plain(120, 90, 77);  // a smaller one
  const Picture sheet = contact_sheet(cells, "Seven");
  for (const SheetCell& cell : cells) EXPECT_TRUE(holds(sheet, cell.picture)) << cell.caption;
  EXPECT_GT(dark_pixels(sheet, 0, 56), 50u) << "the title";
}

TEST(ContactSheet, IsNearlyFourToThree) {
  for (const std::size_t n : {1u, 2u, 4u, 6u, 9u, 12u, 20u, 50u}) {
    const Picture sheet = contact_sheet(std::vector<SheetCell>(n, {plain(480, 360, 0), "x"}), "t");
    const double ratio = static_cast<double>(sheet.width) / sheet.height;
    EXPECT_GT(ratio, 0.6) << n;
    EXPECT_LT(ratio, 2.4) << n;
  }
}

TEST(ContactSheet, HasTheColumnsAskedFor) {
  const std::vector<SheetCell> cells(8, {plain(200, 150, 0), "x"});
  const Picture row = contact_sheet(cells, "t", 8), column = contact_sheet(cells, "t", 1);
  const Picture four = contact_sheet(cells, "t", 4);
  EXPECT_GT(row.width, 8 * 200u);
  EXPECT_LT(row.height, 2 * 150u);
  EXPECT_LT(column.width, 2 * 200u);
  EXPECT_GT(column.height, 8 * 150u);
  EXPECT_TRUE(four.width > 4 * 200u && four.width < 5 * 200u);
  EXPECT_TRUE(holds(contact_sheet(cells, "t", 20), cells[7].picture)) << "more columns than cells";
}

TEST(ContactSheet, WritesCaptionsBelow) {
  const Picture without = contact_sheet({{plain(200, 150, 200), ""}}, "");
  const Picture with = contact_sheet({{plain(200, 150, 200), "best of all"}}, "");
  EXPECT_EQ(dark_pixels(without, 0, without.height), 0u);
  EXPECT_EQ(dark_pixels(with, 0, 56 + 150), 0u);
  EXPECT_GT(dark_pixels(with, 56 + 150, with.height), 100u);
}

TEST(ContactSheet, KeepsLongTextsOnTheSheet) {
  const Picture sheet = contact_sheet({{plain(200, 150, 200), std::string(500, 'W')}}, std::string(500, 'W'));
  for (std::uint32_t y = 0; y < sheet.height; ++y) EXPECT_GT(pixel(sheet, sheet.width - 8, y)[0], 190) << y;
}

TEST(ContactSheet, MayBeEmpty) { EXPECT_GT(contact_sheet({}, "nothing").rgb.size(), 0u); }

TEST(Font, CharactersDiffer) {
  std::set<std::vector<std::uint8_t>> seen;
  for (char c = ' '; c <= '~'; ++c) {
    Picture cell = plain(kCellWidth, kCellHeight, 255);
    draw_text(cell, 0, 0, std::string(1, c), 1, {0, 0, 0});
    EXPECT_TRUE(seen.insert(cell.rgb).second) << c;
    EXPECT_EQ(dark_pixels(cell, 0, kCellHeight) > 0, c != ' ') << c;
  }
}

TEST(Font, ClipsAtTheEdges) {
  Picture small = plain(4, 4, 255);
  draw_text(small, -3, -3, "####", 3, {0, 0, 0});
  draw_text(small, 2, 2, "\xff\n", 3, {0, 0, 0});
  EXPECT_GT(dark_pixels(small, 0, 4), 0u);
}

TEST(Font, CutsTexts) {
  EXPECT_EQ(fit_text("hello", 5), "hello");
  EXPECT_EQ(fit_text("hello", 4), "he..");
  EXPECT_EQ(fit_text("hello", 1), "h");
}

}  // namespace
}  // namespace espalier
