#include "render/svg.h"

#include <gtest/gtest.h>

#include "render/xml_check.h"

namespace espalier {
namespace {

using testing::read_xml;
using testing::XmlDocument;

TEST(Svg, TextIsEscapedAndWhatIsNoTextReplaced) {
  EXPECT_EQ(xml_escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(xml_escaped("Stra\u00dfe \u4e2d \U0001F333"), "Stra\u00dfe \u4e2d \U0001F333");
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(xml_escaped("a\x01z"), "a" + bad + "z");
  EXPECT_EQ(xml_escaped("\xff"), bad);
  EXPECT_EQ(xml_escaped("\xc3"), bad) << "cut short";
  EXPECT_EQ(xml_escaped("\xc0\xaf"), bad + bad) << "longer than need be";
  EXPECT_EQ(xml_escaped("\xed\xa0\x80").find("\xed"), std::string::npos) << "half a surrogate";
}

TEST(Svg, WidthsAreThoseOfTheFont) {
  EXPECT_DOUBLE_EQ(text_width("iW", 1000), 222 + 944);
  EXPECT_DOUBLE_EQ(text_width("~", 10), 5.84);
  EXPECT_GT(text_width("Wing", 12, true), text_width("Wing", 12));
  EXPECT_DOUBLE_EQ(text_width("\u4e2d", 10), 10) << "one character, not three bytes";
}

TEST(Svg, FittedTextIsNeverWiderThanItsRoom) {
  const std::string text = "uniform(\u00e4\u00f6\u00fc, (0.2, 1, 0.2))";
  EXPECT_EQ(fitted(text, 1000, 12), text);
  for (double width = 15; width < 200; width += 7) {
    const std::string cut = fitted(text, width, 12);
    EXPECT_LE(text_width(cut, 12), width);
    EXPECT_EQ(xml_escaped(cut).find("\xEF\xBF\xBD"), std::string::npos) << "cut within a character";
  }
}

TEST(Svg, NumbersAreShort) {
  EXPECT_EQ(svg_number(12), "12");
  EXPECT_EQ(svg_number(-0.04), "0");
  EXPECT_EQ(svg_number(3.14159), "3.1");
}

TEST(Svg, DocumentsAreWellFormedXml) {
  SvgWriter svg;
  svg.rect({0, 0}, {10, 10}, 2, {"#ffffff", "#000000", 1, "4 2"}, "a <hint> & more");
  svg.path("M0 0L5 5", {"", "#112233", 1, ""}, true);
  svg.path("M0 0L5 5", {"", "#112233", 1, ""}, true);
  svg.text({1, 1}, "if a < b & c", {});
  const XmlDocument doc = read_xml(svg.document({100.2, 50}, "T & U", "about <it>"));
  ASSERT_EQ(doc.fault, "");
  EXPECT_EQ(doc.named("svg")[0]->attributes.at("viewBox"), "0 0 101 50");
  EXPECT_EQ(doc.named("marker").size(), 1u) << "one arrowhead a colour";
  EXPECT_EQ(doc.texts(), std::multiset<std::string>{"if a < b & c"});
  EXPECT_EQ(doc.texts("title"), (std::multiset<std::string>{"T & U", "a <hint> & more"}));
}

TEST(Svg, TheReaderOfTheseTestsFindsFaults) {
  EXPECT_EQ(read_xml("<a><b/></a>").fault, "");
  for (const char* bad : {"<a>", "<a></b>", "<a>&</a>", "<a b=\"1\" b=\"2\"/>", "<a/><b/>", "<a b=1/>",
                          "<a>\x01</a>"}) {
    EXPECT_NE(read_xml(bad).fault, "") << bad;
  }
}

}  // namespace
}  // namespace espalier
