#include "io/png.h"

#include <cstdlib>
#include <vector>

#include <zlib.h>

#include "base/check.h"

namespace espalier {
namespace {

void append_u32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
}

std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_u32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  out += type;
  out += data;
  append_u32(out, crc_of(std::string_view(out).substr(start)));
}

std::uint8_t paeth(int left, int above, int corner) {
  const int p = left + above - corner;
  const int a = std::abs(p - left), b = std::abs(p - above), c = std::abs(p - corner);
  return static_cast<std::uint8_t>(a <= b && a <= c ? left : b <= c ? above : corner);
}

/// The row after filter `kind` (PNG specification, section 9), and how far its bytes are from 0 in all.
std::uint64_t filter_row(int kind, std::size_t channels, const std::uint8_t* row, const std::uint8_t* above,
                         std::size_t n, std::uint8_t* out) {
  std::uint64_t cost = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i < channels;
    const int left = first ? 0 : row[i - channels], up = above[i], corner = first ? 0 : above[i - channels];
    const int guess = kind == 1   ? left
                      : kind == 2 ? up
                      : kind == 3 ? (left + up) / 2
                      : kind == 4 ? paeth(left, up, corner)
                                  : 0;
    out[i] = static_cast<std::uint8_t>(row[i] - guess);
    cost += static_cast<std::uint64_t>(std::abs(static_cast<std::int8_t>(out[i])));
  }
  return cost;
}

/// Every row behind the filter that brings its bytes closest to 0: the specification's advice for photographs.
std::string filter(std::uint32_t height, std::size_t stride, std::size_t channels,
                   std::span<const std::uint8_t> pixels) {
  std::string out;
  out.reserve((stride + 1) * height);
  const std::vector<std::uint8_t> nothing(stride);
  std::vector<std::uint8_t> best(stride), candidate(stride);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::uint8_t* row = pixels.data() + y * stride;
    const std::uint8_t* above = y > 0 ? row - stride : nothing.data();
    std::uint64_t least = ~std::uint64_t{0};
    char chosen = 0;
    for (int kind = 0; kind < 5; ++kind) {
      const std::uint64_t cost = filter_row(kind, channels, row, above, stride, candidate.data());
      if (cost < least) least = cost, chosen = static_cast<char>(kind), best.swap(candidate);
    }
    out += chosen;
    out.append(reinterpret_cast<const char*>(best.data()), stride);
  }
  return out;
}

std::string deflate_all(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 6);
  CHECK(status == Z_OK);
  out.resize(size);
  return out;
}

std::string encode(std::uint32_t width, std::uint32_t height, std::size_t channels,
                   std::span<const std::uint8_t> pixels, std::string_view keyword, std::string_view text) {
  CHECK(width > 0 && height > 0 && pixels.size() == channels * width * height);
  std::string out(kPngSignature), head;
  append_u32(head, width);
  append_u32(head, height);
  head += '\x08';  // bits per channel
  head += channels == 4 ? '\x06' : '\x02';
  head += std::string_view("\x00\x00\x00", 3);  // deflate, adaptive filters, no interlace
  append_chunk(out, "IHDR", head);
  append_chunk(out, "sRGB", std::string_view("\0", 1));
  if (!keyword.empty()) append_chunk(out, "tEXt", std::string(keyword) + '\0' + std::string(text));
  append_chunk(out, "IDAT", deflate_all(filter(height, channels * width, channels, pixels)));
  append_chunk(out, "IEND", "");
  return out;
}

}  // namespace

std::string encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb,
                       std::string_view keyword, std::string_view text) {
  return encode(width, height, 3, rgb, keyword, text);
}

std::string encode_png_with_alpha(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                  std::string_view keyword, std::string_view text) {
  bool opaque = true;
  for (std::size_t i = 3; i < rgba.size(); i += 4) opaque &= rgba[i] == 255;
  if (!opaque) return encode(width, height, 4, rgba, keyword, text);
  std::vector<std::uint8_t> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  return encode(width, height, 3, rgb, keyword, text);
}

std::optional<std::string> find_png_text(std::string_view png, std::string_view keyword) {
  if (!png.starts_with(kPngSignature)) return std::nullopt;
  for (std::size_t at = kPngSignature.size(); at + 12 <= png.size();) {
    const std::size_t length = read_u32(png, at);
    if (length > png.size() - at - 12) return std::nullopt;
    const std::string_view chunk = png.substr(at + 4, length + 4), data = chunk.substr(4);
    if (chunk.starts_with("tEXt") && data.size() > keyword.size() && data.starts_with(keyword) &&
        data[keyword.size()] == '\0' && crc_of(chunk) == read_u32(png, at + 8 + length)) {
      return std::string(data.substr(keyword.size() + 1));
    }
    at += 12 + length;
  }
  return std::nullopt;
}

}  // namespace espalier
