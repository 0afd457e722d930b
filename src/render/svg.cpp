#include "render/svg.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace espalier {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
constexpr double kBold = 1.08;  // bold letters are about that much wider

// Helvetica's widths in thousandths of the size, from space to tilde.
constexpr std::array<std::uint16_t, 95> kWidths = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,  // space to /
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,  // 0 to ?
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,  // @ to O
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,  // P to _
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,  // ` to o
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};      // p to ~

struct Character {
  std::size_t bytes = 1;
  std::uint32_t code = 0;
  bool valid = false;
};

// The character that `text`, which is not empty, begins with.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {1, lead, lead >= 0x20 && lead != 0x7f};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool control = code < 0xa0 || code == 0xfffe || code == 0xffff;
  return {bytes, code, code >= kLeast[bytes] && code <= 0x10ffff && !surrogate && !control};
}

double character_width(const Character& c) {
  if (c.valid && c.code < 0x7f) return kWidths[c.code - 0x20] * 1e-3;
  if (c.code == 0x2026 || c.code >= 0x2e80) return 1;  // ellipsis; East Asian
  return 0.6;
}

std::string paint(const SvgStyle& style) {
  std::string text = fmt::format(" fill=\"{}\"", style.fill.empty() ? "none" : style.fill);
  if (style.stroke.empty()) return text;
  text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", style.stroke, svg_number(style.width));
  if (!style.dashes.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", style.dashes);
  return text;
}

}  // namespace

double text_width(std::string_view utf8, double size, bool bold) {
  double width = 0;
  while (!utf8.empty()) {
    const Character c = first_character(utf8);
    width += character_width(c);
    utf8.remove_prefix(c.bytes);
  }
  return width * size * (bold ? kBold : 1);
}

std::string fitted(std::string_view utf8, double width, double size, bool bold) {
  if (text_width(utf8, size, bold) <= width) return std::string(utf8);
  constexpr std::string_view kEllipsis = "\xE2\x80\xA6";
  const double room = width - text_width(kEllipsis, size, bold);
  std::size_t kept = 0;
  double used = 0;
  while (kept < utf8.size()) {
    const Character c = first_character(utf8.substr(kept));
    used += character_width(c) * size * (bold ? kBold : 1);
    if (used > room) break;
    kept += c.bytes;
  }
  return std::string(utf8.substr(0, kept)) + std::string(kEllipsis);
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character c = first_character(text);
    if (!c.valid) out += kReplacement;
    else if (c.code == '&') out += "&amp;";
    else if (c.code == '<') out += "&lt;";
    else if (c.code == '>') out += "&gt;";
    else if (c.code == '"') out += "&quot;";
    else out += text.substr(0, c.bytes);
    text.remove_prefix(c.bytes);
  }
  return out;
}

std::string svg_number(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

void SvgWriter::close(std::string_view element, std::string_view hint) {
  body_ += hint.empty() ? "/>\n" : fmt::format("><title>{}</title></{}>\n", xml_escaped(hint), element);
}

void SvgWriter::rect(Point2 at, Point2 size, double radius, const SvgStyle& style, std::string_view hint) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"{}", svg_number(at.x),
                       svg_number(at.y), svg_number(size.x), svg_number(size.y), svg_number(radius), paint(style));
  close("rect", hint);
}

void SvgWriter::circle(Point2 centre, double radius, const SvgStyle& style, std::string_view hint) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}", svg_number(centre.x), svg_number(centre.y),
                       svg_number(radius), paint(style));
  close("circle", hint);
}

void SvgWriter::path(const std::string& d, const SvgStyle& style, bool arrow, std::string_view hint) {
  body_ += fmt::format("<path d=\"{}\"{}{}", d, paint(style),
                       arrow ? fmt::format(" marker-end=\"url(#arrow-{})\"", style.stroke.substr(1)) : "");
  close("path", hint);
}

void SvgWriter::line(Point2 from, Point2 to, const SvgStyle& style) {
  path(fmt::format("M{} {}L{} {}", svg_number(from.x), svg_number(from.y), svg_number(to.x), svg_number(to.y)), style);
}

void SvgWriter::text(Point2 at, std::string_view words, const SvgText& style) {
  if (words.empty()) return;
  constexpr const char* kAnchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"{}{}{} textLength=\"{}\" "
                       "lengthAdjust=\"spacingAndGlyphs\">{}</text>\n",
                       svg_number(at.x), svg_number(at.y), svg_number(style.size), style.color,
                       style.bold ? " font-weight=\"bold\"" : "", style.italic ? " font-style=\"italic\"" : "",
                       kAnchors[static_cast<int>(style.anchor)],
                       svg_number(text_width(words, style.size, style.bold)), xml_escaped(words));
}

std::string SvgWriter::document(Point2 size, std::string_view title, std::string_view about) const {
  const std::string width = svg_number(std::ceil(size.x)), height = svg_number(std::ceil(size.y));
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"Arial, Helvetica, 'Liberation Sans', sans-serif\">\n"
      "<title>{2}</title>\n<desc>{3}</desc>\n<defs>\n",
      width, height, xml_escaped(title), xml_escaped(about));
  // One arrowhead for every colour that asks for one.
  constexpr std::string_view kAsks = "url(#arrow-";
  std::string made;
  for (std::size_t at = body_.find(kAsks); at != std::string::npos; at = body_.find(kAsks, at + 1)) {
    const std::string color = body_.substr(at + kAsks.size(), 6);
    if (made.find(color) != std::string::npos) continue;
    made += color + " ";
    out += fmt::format(
        "<marker id=\"arrow-{0}\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"9\" markerHeight=\"9\" "
        "markerUnits=\"userSpaceOnUse\" orient=\"auto\"><path d=\"M0 1L10 5L0 9z\" fill=\"#{0}\"/></marker>\n",
        color);
  }
  return out + fmt::format("</defs>\n<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", width, height) + body_ +
         "</svg>\n";
}

}  // namespace espalier
