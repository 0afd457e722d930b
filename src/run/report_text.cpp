#include "run/report_text.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/base64.h"
#include "base/check.h"

namespace espalier {
namespace {

/// sRGB bytes as 16-bit values that add up, and back. Squares are near enough to the curve of sRGB for means of
/// neighbours, and exact.
std::uint32_t to_light(std::uint8_t byte) { return std::uint32_t{byte} * byte; }

std::uint8_t from_light(std::uint64_t light) {
  std::uint32_t low = 0, high = 255;
  while (low < high) {  // the byte whose square is nearest
    const std::uint32_t middle = (low + high + 1) / 2;
    if (std::uint64_t{middle} * middle - middle < light) low = middle;
    else high = middle - 1;
  }
  return static_cast<std::uint8_t>(low);
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      case '\n': case '\t': out += c; break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) out += "\xef\xbf\xbd";
        else out += c;
    }
  }
  return out;
}

std::string json_for_script(std::string json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    switch (c) {
      case '<': out += "\\u003c"; break;
      case '>': out += "\\u003e"; break;
      case '&': out += "\\u0026"; break;
      default: out += c;
    }
  }
  return out;
}

std::string url_component(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '.' || c == '_' || c == '~';
    if (plain) out += c;
    else out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string png_url(std::string_view png) { return "data:image/png;base64," + encode_base64(png); }

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t begin = text.find("{{", at);
    out += text.substr(at, begin - at);
    if (begin == std::string_view::npos) return out;
    const std::size_t end = text.find("}}", begin);
    CHECK(end != std::string_view::npos);
    const auto value = values.find(std::string(text.substr(begin + 2, end - begin - 2)));
    CHECK(value != values.end());
    out += value->second;
    at = end + 2;
  }
}

std::string readable_number(double value) {
  std::string text = std::fabs(value) < 1e6 ? fmt::format("{:.6g}", value + 0.0) : fmt::format("{:.0f}", value);
  if (text.find_first_of("en") != std::string::npos || std::fabs(value) >= 1e15) return fmt::format("{:.6g}", value);
  std::size_t at = std::min(text.find('.'), text.size());
  const std::size_t first = text[0] == '-' ? 1 : 0;
  while (at > first + 3) text.insert(at -= 3, ",");
  return text;
}

Picture shrunk(const Picture& picture, std::uint32_t most) {
  CHECK(most > 0);
  const std::uint32_t factor = (picture.width + most - 1) / most;
  if (factor <= 1) return picture;
  Picture small;
  small.width = std::max(1u, picture.width / factor), small.height = std::max(1u, picture.height / factor);
  small.rgb.resize(std::size_t{3} * small.width * small.height);
  const std::uint32_t rows = std::min(factor, picture.height);
  for (std::size_t out = 0; out < small.rgb.size(); ++out) {
    const std::size_t x = out / 3 % small.width * factor, y = out / 3 / small.width * factor;
    std::uint64_t sum = 0;
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < factor; ++i)
        sum += to_light(picture.rgb[3 * (x + i + picture.width * (y + j)) + out % 3]);
    }
    small.rgb[out] = from_light((sum + rows * factor / 2) / (std::uint64_t{rows} * factor));
  }
  return small;
}

}  // namespace espalier
