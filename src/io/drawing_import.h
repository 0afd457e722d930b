#pragma once
// Drawings: image files read as numbers, for targets. PNG (8 or 16 bit) and JPG hold light and alpha, PFM signed
// weights.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// Row by row from the top left.
struct Drawing {
  std::uint32_t width = 0, height = 0;
  bool signed_weights = false;
  /// Light in 0..1 (Rec. 709 luma of the values as they are stored: a drawing's greys mean what they look like), or
  /// weights: any finite values.
  std::vector<float> values;
  std::vector<float> alpha;  // 0..1, one per value; empty: all is opaque
};

/// Nothing is lost: 16-bit greys come as value / 65535; in 8 bit, whose middle lies between 127 and 128, both of these
/// greys are 0.5. Throws Error naming the file and what is wrong with it: neither of the formats, damaged, more than
/// Image::kMostSide pixels a side or Image::kMostPixels in all, or (PFM) a value that is not finite or beyond 1e6.
Drawing load_drawing(const std::string& path);

/// The same from the bytes of a PFM file ("Pf" grey or "PF" colour, either byte order). Errors name no file.
Drawing parse_pfm(std::string_view bytes);

}  // namespace espalier
