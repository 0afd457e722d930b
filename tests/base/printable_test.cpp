#include "base/printable.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

TEST(Printable, TextStaysAsItIs) {
  const std::string text = "a \"b\" \\ \xc3\xa9 \xe2\x82\xac \xed\x9f\xbf \xf0\x9f\x8c\xb2 \xf4\x8f\xbf\xbf";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable(std::string("\0\x1b[2J\t\x7f\r\n", 9)), "\\x00\\x1b[2J\\x09\\x7f\\x0d\\x0a");
  EXPECT_EQ(printable("a\nb\r", true), "a\nb\\x0d");
  EXPECT_EQ(printable("\xc2\x9b" "2J"), "\\xc2\\x9b2J");
}

TEST(Printable, WhatIsNoUtf8IsEscaped) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
  EXPECT_EQ(printable("\xc3("), "\\xc3(");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");
  EXPECT_EQ(printable("\xe0\x80\x80"), "\\xe0\\x80\\x80");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(printable("\xf0\x9f\x8c"), "\\xf0\\x9f\\x8c");
}

}  // namespace
}  // namespace espalier
