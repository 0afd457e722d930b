// PFM: pictures of floats, bottom row first.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "base/error.h"
#include "io/drawing_import.h"
#include "io/image_format.h"

namespace espalier {
namespace {

constexpr double kMostValue = 1e6;

struct Header {
  std::uint32_t width = 0, height = 0, channels = 1;
  bool little_endian = true;
  std::size_t size = 0;  // bytes, the single white space that ends it included
};

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// The next word of the header, and one white space behind it.
std::string_view next_word(std::string_view bytes, std::size_t& at) {
  while (at < bytes.size() && is_space(bytes[at])) ++at;
  const std::size_t begin = at;
  while (at < bytes.size() && !is_space(bytes[at]) && at - begin < 40) ++at;
  if (at == begin || at >= bytes.size() || !is_space(bytes[at])) throw Error("it is damaged (its header is cut short)");
  return bytes.substr(begin, at++ - begin);
}

template <class Number>
Number parse(std::string_view word, std::string_view what) {
  Number number{};
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (code != std::errc() || end != word.data() + word.size())
    throw Error(fmt::format("it is damaged ({}, got \"{}\")", what, word));
  return number;
}

Header parse_header(std::string_view bytes) {
  Header header;
  std::size_t at = 0;
  header.channels = next_word(bytes, at) == "PF" ? 3 : 1;
  header.width = parse<std::uint32_t>(next_word(bytes, at), "its width must be a whole number");
  header.height = parse<std::uint32_t>(next_word(bytes, at), "its height must be a whole number");
  check_image_size(header.width, header.height);
  // Its sign tells the order of bytes; its size is a unit of light that means nothing here.
  const auto scale = parse<double>(next_word(bytes, at), "its scale must be a number");
  if (!std::isfinite(scale) || scale == 0) throw Error("it is damaged (its scale must be a number other than 0)");
  header.little_endian = scale < 0;
  header.size = at;
  return header;
}

float read_float(const char* from, bool little_endian) {
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned shift = little_endian ? 8 * i : 24 - 8 * i;
    bits |= std::uint32_t{static_cast<unsigned char>(from[i])} << shift;
  }
  return std::bit_cast<float>(bits);
}

}  // namespace

Drawing parse_pfm(std::string_view bytes) {
  const Header header = parse_header(bytes);
  const std::uint64_t wanted = std::uint64_t{4} * header.channels * header.width * header.height;
  const std::uint64_t got = bytes.size() - header.size;
  if (got != wanted) throw Error(fmt::format("it is damaged ({} bytes of pixels instead of {})", got, wanted));

  Drawing drawing{header.width, header.height, true, {}, {}};
  drawing.values.reserve(std::size_t{header.width} * header.height);
  for (std::uint32_t y = 0; y < header.height; ++y) {
    const std::size_t row = std::size_t{header.height - 1 - y} * header.width;
    for (std::uint32_t x = 0; x < header.width; ++x) {
      float channel[3] = {};
      for (std::uint32_t c = 0; c < header.channels; ++c) {
        channel[c] = read_float(bytes.data() + header.size + 4 * ((row + x) * header.channels + c),
                                header.little_endian);
        if (!(std::abs(channel[c]) <= kMostValue))
          throw Error(fmt::format("column {} of row {} (from the top) must be a finite number of at most {}, got {}",
                                  x, y, kMostValue, channel[c]));
      }
      drawing.values.push_back(header.channels == 1 ? channel[0] : luma(channel[0], channel[1], channel[2]));
    }
  }
  return drawing;
}

}  // namespace espalier
