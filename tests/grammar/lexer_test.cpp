#include "grammar/lexer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace espalier {
namespace {

std::vector<std::string> texts(std::string_view source) {
  Diagnostics diagnostics;
  std::vector<std::string> result;
  for (const Token& token : tokenize(source, diagnostics)) result.emplace_back(token.text);
  EXPECT_FALSE(diagnostics.has_errors()) << render(diagnostics, "test", source);
  return result;
}

std::vector<std::string> codes(std::string_view source) {
  Diagnostics diagnostics;
  tokenize(source, diagnostics);
  std::vector<std::string> result;
  for (const Diagnostic& d : diagnostics.items()) result.push_back(d.code);
  return result;
}

Token first(std::string_view source) {
  Diagnostics diagnostics;
  return tokenize(source, diagnostics).front();
}

TEST(Lexer, TakesTheLongestSymbol) {
  EXPECT_THAT(texts("a->b<=c<d..e.x!=f=="),
              testing::ElementsAre("a", "->", "b", "<=", "c", "<", "d", "..", "e", ".", "x", "!=", "f", "==", ""));
}

TEST(Lexer, TellsRangesFromDecimals) {
  EXPECT_THAT(texts("0..1"), testing::ElementsAre("0", "..", "1", ""));
  EXPECT_THAT(texts("0.5..1.25"), testing::ElementsAre("0.5", "..", "1.25", ""));
}

TEST(Lexer, ReadsNumbersWithUnits) {
  EXPECT_EQ(first("90deg").unit, ast::Unit::degrees);
  EXPECT_EQ(first("1.5rad").unit, ast::Unit::radians);
  EXPECT_EQ(first("3m").unit, ast::Unit::metres);
  EXPECT_EQ(first("3cm").unit, ast::Unit::centimetres);
  EXPECT_EQ(first("3mm").unit, ast::Unit::millimetres);
  EXPECT_EQ(first("3%").unit, ast::Unit::percent);
  EXPECT_EQ(first("3").unit, ast::Unit::none);
  EXPECT_EQ(first("1.5e-2m").value, 1.5e-2);
  EXPECT_EQ(first("1e-999").value, 0);
}

TEST(Lexer, RefusesUnitsThatItDoesNotKnow) {
  EXPECT_THAT(codes("3km 4e 1e999"), testing::ElementsAre("E0103", "E0103", "E0103"));
}

TEST(Lexer, SkipsCommentsAndByteOrderMark) {
  EXPECT_THAT(texts("\xef\xbb\xbf"
                    "a # b ~ \x01 \xff\r\n c"),
              testing::ElementsAre("a", "c", ""));
}

TEST(Lexer, CountsLinesAndColumnsInBytes) {
  Diagnostics diagnostics;
  const std::vector<Token> tokens = tokenize("a\n  b \"\xc3\xa4\" c", diagnostics);
  EXPECT_EQ(tokens[1].span.line, 2u);
  EXPECT_EQ(tokens[1].span.column, 3u);
  EXPECT_EQ(tokens[1].span.offset, 4u);
  EXPECT_EQ(tokens[3].span.column, 10u);
}

TEST(Lexer, HoldsTextsToUtf8WithoutControls) {
  EXPECT_EQ(first("\"\xf0\x9f\x8c\xb3 tree\"").text, "\xf0\x9f\x8c\xb3 tree");
  EXPECT_THAT(codes("\"\xc0\xaf\""), testing::ElementsAre("E0104"));      // overlong
  EXPECT_THAT(codes("\"\xed\xa0\x80\""), testing::ElementsAre("E0104"));  // surrogate
  EXPECT_THAT(codes("\"\xf5\x80\x80\x80\""), testing::ElementsAre("E0104"));
  EXPECT_THAT(codes("\"a\tb\""), testing::ElementsAre("E0104"));
  EXPECT_THAT(codes("\"open"), testing::ElementsAre("E0102"));
}

TEST(Lexer, ReportsARunOfStrayCharactersOnce) {
  EXPECT_THAT(codes("a && b ;;; c"), testing::ElementsAre("E0101", "E0101"));
  EXPECT_THAT(codes("\xc3\xa4\xc3\xb6\xc3\xbc"), testing::ElementsAre("E0101"));
}

TEST(Lexer, StopsAfterTheErrorsThatAreKept) {
  std::string source;
  for (int i = 0; i < 1000; ++i) source += "; a ";
  EXPECT_EQ(codes(source).size(), Diagnostics::kMostErrors);
}

RC_GTEST_PROP(Lexer, TokensLieInOrderInTheSource, (const std::string& source)) {
  Diagnostics diagnostics;
  std::size_t end = 0;
  for (const Token& token : tokenize(source, diagnostics)) {
    RC_ASSERT(token.span.offset >= end);
    end = token.span.offset + token.span.length;
    RC_ASSERT(end <= source.size());
  }
}

}  // namespace
}  // namespace espalier
