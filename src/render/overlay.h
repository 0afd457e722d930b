#pragma once
// Overlay: what a silhouette covers of a drawing, pixel by pixel in colours: hit, missed, spilled. Also the drawing
// alone, as it is understood. Legends for these and other pictures.

#include <cstdint>
#include <string>
#include <vector>

#include "render/paint.h"

namespace espalier {

/// What a pixel is. Of a drawing alone: wanted, to_avoid or indifferent; under a silhouette the others.
enum class Mark : std::uint8_t {
  free,         // to be left free, and is
  missed,       // wanted, not covered
  hit,          // wanted and covered
  spilled,      // to be left free, and covered
  indifferent,  // does not matter, not covered
  covered,      // does not matter, covered
  wanted,
  to_avoid,
};

struct MarkedPixels {
  std::uint32_t width = 0, height = 0;
  std::vector<Mark> marks;            // row by row from the top left
  std::vector<std::uint8_t> degrees;  // how much each is wanted, or not: 255 fully
};

/// Of a mark at its full degree. Blue, amber and vermilion differ in lightness, so that eyes without one kind of cones
/// tell them apart as well.
Colour colour_of(Mark mark);

inline constexpr std::uint32_t kOverlayAcross = 1024;

/// Enlarged by the largest whole factor with which the longer side has at most `across` pixels; then a line shows the
/// border of what is wanted. Larger ones are fitted.
Picture draw_marks(const MarkedPixels& pixels, std::uint32_t across = kOverlayAcross);
/// Larger or smaller, so that the longer side has exactly `across` pixels, each the mean of what it shows.
Picture fit_marks(const MarkedPixels& pixels, std::uint32_t across);

struct LegendRow {
  std::vector<Colour> swatches;  // side by side; none: text alone
  std::string text;              // printable ASCII
};

/// The picture on paper with a title above and rows below, all in letters that suit its width.
Picture with_legend(const Picture& picture, const std::string& title, const std::vector<LegendRow>& rows);

}  // namespace espalier
