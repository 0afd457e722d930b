#pragma once
// SvgWriter: a picture of lines, boxes and text as one SVG document. Lengths are pixels at 100 %, x to the right, y
// down. Text is measured by a fixed table, so the same picture is the same bytes everywhere; every line of text carries
// its length, so it fits its box in any font.

#include <string>
#include <string_view>

namespace espalier {

struct Point2 {
  double x = 0, y = 0;
};

/// How a line or an area is drawn. Empty colours draw nothing.
struct SvgStyle {
  std::string fill, stroke;
  double width = 1;      // of the stroke
  std::string dashes;    // "6 4"; empty: solid
};

enum class Anchor { start, middle, end };

struct SvgText {
  double size = 12;
  std::string color = "#1c2430";
  bool bold = false, italic = false;
  Anchor anchor = Anchor::start;
};

/// Width in pixels of a line of text, by the widths of Helvetica and Arial. UTF-8; what is not ASCII counts as wide.
double text_width(std::string_view utf8, double size, bool bold = false);
/// The text, or as much of it as fits in `width` and an ellipsis. Cuts between characters.
std::string fitted(std::string_view utf8, double width, double size, bool bold = false);
/// With & < > " as entities; what is not UTF-8, and control characters, as U+FFFD.
std::string xml_escaped(std::string_view text);
/// A length with one decimal, without trailing ".0".
std::string svg_number(double value);

class SvgWriter {
 public:
  /// `hint`, where it is not empty, is what a browser shows when the pointer rests on the element.
  void rect(Point2 at, Point2 size, double radius, const SvgStyle& style, std::string_view hint = {});
  void circle(Point2 centre, double radius, const SvgStyle& style, std::string_view hint = {});
  /// `d`: path data. `arrow`: an arrowhead in the stroke's colour at its end.
  void path(const std::string& d, const SvgStyle& style, bool arrow = false, std::string_view hint = {});
  void line(Point2 from, Point2 to, const SvgStyle& style);
  /// The point is on the base line.
  void text(Point2 at, std::string_view words, const SvgText& style);

  /// The whole document on a white ground, sized and with a viewBox. `title` and `about` describe it to readers that
  /// cannot see it.
  std::string document(Point2 size, std::string_view title, std::string_view about) const;

 private:
  void close(std::string_view element, std::string_view hint);

  std::string body_;
};

}  // namespace espalier
