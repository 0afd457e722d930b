#pragma once
// PNG as bytes: the encoder behind write_png, and the text chunks of any PNG.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace espalier {

inline constexpr std::string_view kPngSignature{"\x89PNG\r\n\x1a\n", 8};

/// 8-bit sRGB, rows from the top. A tEXt chunk `keyword` holds `text` (ASCII) before the picture.
std::string encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb,
                       std::string_view keyword, std::string_view text);

/// The same with alpha (not multiplied in), rgba[4 * (x + width * y) + channel]; where all is opaque the file has none.
/// Without a text chunk if `keyword` is empty.
std::string encode_png_with_alpha(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                  std::string_view keyword = {}, std::string_view text = {});

/// The text of the first tEXt chunk called `keyword`; none for anything that is not a PNG or has no such chunk.
std::optional<std::string> find_png_text(std::string_view png, std::string_view keyword);

}  // namespace espalier
