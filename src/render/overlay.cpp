#include "render/overlay.h"

#include <algorithm>

#include "base/check.h"
#include "render/font.h"

namespace espalier {
namespace {

constexpr Colour kWhite{{255, 255, 255}}, kBorder{{24, 30, 40}};
constexpr Colour kHatch{{214, 216, 219}}, kHatchGap{{236, 237, 238}};
constexpr std::uint32_t kHatchStep = 8, kBorderFrom = 3;  // pixels; borders are drawn from this factor on
constexpr std::uint32_t kLeastDegree = 96;                // of 256: how strong the faintest colours are
constexpr std::uint32_t kMinWidth = 480, kLegendCells = 52, kMostScale = 3;

/// At its degree; (x, y) are of the picture drawn, for patterns.
Colour colour_at(Mark mark, std::uint8_t degree, std::uint32_t x, std::uint32_t y) {
  if (mark == Mark::free) return kWhite;
  if (mark == Mark::indifferent) return (x + y) % kHatchStep < 2 ? kHatch : kHatchGap;
  const Colour full = colour_of(mark);
  if (mark == Mark::covered) return full;
  return mix(kWhite, full, kLeastDegree + (256 - kLeastDegree) * degree / 255);
}

bool is_wanted(Mark mark) { return mark == Mark::missed || mark == Mark::hit || mark == Mark::wanted; }

Picture enlarged(const MarkedPixels& pixels, std::uint32_t factor) {
  Picture out = blank(pixels.width * factor, pixels.height * factor, kWhite);
  for (std::uint32_t y = 0; y < out.height; ++y) {
    for (std::uint32_t x = 0; x < out.width; ++x) {
      const std::size_t at = x / factor + std::size_t{y / factor} * pixels.width;
      set_pixel(out, x, y, colour_at(pixels.marks[at], pixels.degrees[at], x, y));
    }
  }
  return out;
}

/// A line along the inner side of what is wanted.
void draw_border(Picture& picture, const MarkedPixels& pixels, std::uint32_t factor) {
  const auto wanted = [&](std::int64_t x, std::int64_t y) {
    return x >= 0 && y >= 0 && x < pixels.width && y < pixels.height &&
           is_wanted(pixels.marks[static_cast<std::size_t>(x + y * pixels.width)]);
  };
  for (std::uint32_t y = 0; y < pixels.height; ++y) {
    for (std::uint32_t x = 0; x < pixels.width; ++x) {
      if (!wanted(x, y)) continue;
      const std::int64_t left = std::int64_t{x} * factor, top = std::int64_t{y} * factor;
      if (!wanted(std::int64_t{x} - 1, y)) fill_box(picture, left, top, 1, factor, kBorder);
      if (!wanted(x + 1, y)) fill_box(picture, left + factor - 1, top, 1, factor, kBorder);
      if (!wanted(x, std::int64_t{y} - 1)) fill_box(picture, left, top, factor, 1, kBorder);
      if (!wanted(x, y + 1)) fill_box(picture, left, top + factor - 1, factor, 1, kBorder);
    }
  }
}

}  // namespace

Colour colour_of(Mark mark) {
  switch (mark) {
    case Mark::free: return kWhite;
    case Mark::missed: return {{247, 190, 60}};
    case Mark::hit:
    case Mark::wanted: return {{20, 92, 170}};
    case Mark::spilled: return {{205, 62, 20}};
    case Mark::indifferent: return kHatch;
    case Mark::covered: return {{146, 150, 156}};
    case Mark::to_avoid: return {{250, 214, 200}};
  }
  return kWhite;
}

Picture draw_marks(const MarkedPixels& pixels, std::uint32_t across) {
  CHECK(pixels.width > 0 && pixels.height > 0 && across > 0);
  CHECK(pixels.marks.size() == std::size_t{pixels.width} * pixels.height);
  CHECK(pixels.degrees.size() == pixels.marks.size());
  const std::uint32_t longer = std::max(pixels.width, pixels.height);
  if (longer > across) return fit_marks(pixels, across);
  const std::uint32_t factor = across / longer;
  Picture picture = enlarged(pixels, factor);
  if (factor >= kBorderFrom) draw_border(picture, pixels, factor);
  return picture;
}

Picture fit_marks(const MarkedPixels& pixels, std::uint32_t across) {
  const std::uint64_t longer = std::max(pixels.width, pixels.height);
  const std::uint64_t samples = std::clamp<std::uint64_t>((2 * longer + across - 1) / across, 3, 16);  // along a side
  const auto side = [&](std::uint64_t of) {
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(1, of * across / longer));
  };
  Picture out = blank(side(pixels.width), side(pixels.height), kWhite);
  for (std::uint32_t y = 0; y < out.height; ++y) {
    for (std::uint32_t x = 0; x < out.width; ++x) {
      std::uint64_t sum[3] = {0, 0, 0};
      for (std::uint64_t k = 0; k < samples * samples; ++k) {
        const std::uint64_t u = (2 * (x * samples + k % samples) + 1) * pixels.width / (2 * samples * out.width);
        const std::uint64_t v = (2 * (y * samples + k / samples) + 1) * pixels.height / (2 * samples * out.height);
        const Colour colour = colour_at(pixels.marks[u + v * pixels.width], pixels.degrees[u + v * pixels.width], x, y);
        for (int c = 0; c < 3; ++c) sum[c] += colour.rgb[c];
      }
      Colour mean{};
      const std::uint64_t count = samples * samples;
      for (int c = 0; c < 3; ++c) mean.rgb[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
      set_pixel(out, x, y, mean);
    }
  }
  return out;
}

Picture with_legend(const Picture& picture, const std::string& title, const std::vector<LegendRow>& rows) {
  const std::uint32_t inside = std::max(picture.width, kMinWidth);
  const std::uint32_t scale = std::clamp(inside / (kLegendCells * kCellWidth), 1u, kMostScale);
  const std::uint32_t gap = 8 * scale, line = (kCellHeight + 3) * scale;
  const std::uint32_t above = title.empty() ? gap : gap + line;
  const auto below = static_cast<std::uint32_t>(gap + line * rows.size());
  Picture sheet = blank(inside + 2 * gap, above + picture.height + below, kPaper);
  const std::size_t cells = inside / (kCellWidth * scale);
  draw_text(sheet, gap, gap, fit_text(title, cells), scale, kInk.rgb);
  const std::uint32_t left = gap + (inside - picture.width) / 2;
  paste(sheet, picture, left, above);
  draw_frame(sheet, left, above, picture.width, picture.height, kFrame);
  std::int64_t y = above + picture.height + gap;
  for (const LegendRow& row : rows) {
    std::int64_t x = gap;
    const std::int64_t side = 7 * scale;
    for (const Colour& colour : row.swatches) {
      fill_box(sheet, x, y, side, side, colour);
      draw_frame(sheet, x, y, side, side, kFaintInk);
      x += side + 2 * scale;
    }
    if (!row.swatches.empty()) x += 4 * scale;
    const auto left_cells = static_cast<std::size_t>((inside + gap - x) / (kCellWidth * scale));
    draw_text(sheet, x, y, fit_text(row.text, left_cells), scale, kInk.rgb);
    y += line;
  }
  return sheet;
}

}  // namespace espalier
