// The formatter: what its layout is, and that it changes nothing else.

#include "grammar/formatter.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "grammar/fences.h"
#include "grammar/lexer.h"
#include "grammar/parser.h"
#include "grammar/tree_text.h"

namespace espalier {
namespace {

std::string format(const std::string& source) {
  Diagnostics diagnostics;
  const std::optional<std::string> text = format_grammar(source, diagnostics);
  return text ? *text : render(diagnostics, "test", source);
}

std::string tree(const std::string& source) {
  Diagnostics diagnostics;
  const ast::Grammar grammar = parse(source, diagnostics);
  return diagnostics.has_errors() ? "does not parse" : testing::TreeText::of(grammar);
}

/// Each comment with the number of tokens before it.
std::vector<std::string> comments(const std::string& source) {
  Diagnostics diagnostics;
  std::vector<Comment> found;
  tokenize(source, diagnostics, 0, &found);
  std::vector<std::string> result;
  for (const Comment& c : found) result.push_back(fmt::format("{} {} {}", c.next_token, c.own_line, c.text));
  return result;
}

int longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);)
    longest = std::max(longest, std::min(line.size(), line.find('#')));
  return static_cast<int>(longest);
}

void expect_faithful(const std::string& source) {
  const std::string formatted = format(source);
  EXPECT_EQ(tree(formatted), tree(source)) << source << "\nbecame\n" << formatted;
  EXPECT_EQ(comments(formatted), comments(source));
  EXPECT_EQ(format(formatted), formatted) << "is not idempotent for\n" << source;
}

std::vector<std::string> known_grammars() {
  std::vector<std::string> result;
  for (const char* folder : {"grammars", "tests/grammar/corpus/pass"})
    for (const auto& path : testing::files_in(folder, ".esp")) result.push_back(testing::text_of(path));
  for (const testing::Fence& fence : testing::all_fences()) result.push_back(fence.text);
  return result;
}

TEST(Formatter, KeepsTreesAndCommentsOfAllThatIsThere) {
  const std::vector<std::string> grammars = known_grammars();
  ASSERT_GE(grammars.size(), 40u);
  for (const std::string& source : grammars) {
    expect_faithful(source);
    EXPECT_LE(longest_line(format(source)), kLongestLine);
  }
}

TEST(Formatter, LeavesShippedGrammarsAsTheyAre) {
  for (const auto& path : testing::files_in("grammars", ".esp")) {
    const std::string source = testing::text_of(path);
    EXPECT_EQ(format(source), source) << path;
  }
}

/// What may stand between two tokens: blanks, line ends, comments.
std::string random_blanks(bool needed) {
  std::string text;
  const int pieces = *rc::gen::inRange(needed ? 1 : 0, 4);
  for (int i = 0; i < pieces; ++i) {
    switch (*rc::gen::inRange(0, 8)) {
      case 0: text += "\n"; break;
      case 1: text += "\t"; break;
      case 2: text += "\r\n"; break;
      case 3: text += fmt::format("# note {} \n", *rc::gen::inRange(0, 100)); break;
      case 4: text += "  "; break;
      default: text += " ";
    }
  }
  return text;
}

/// The tokens of a grammar with other blanks and comments between them.
std::string shaken(const std::string& source) {
  Diagnostics diagnostics;
  const std::vector<Token> tokens = tokenize(source, diagnostics);
  std::string text = random_blanks(false);
  const int lively = *rc::gen::inRange(1, 12);  // one gap in so many is changed
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const std::uint32_t end = tokens[i].span.offset + tokens[i].span.length;
    text += source.substr(tokens[i].span.offset, tokens[i].span.length);
    const bool apart = i + 2 < tokens.size() && tokens[i + 1].span.offset > end;
    if (*rc::gen::inRange(0, lively) == 0) text += random_blanks(apart);
    else text += source.substr(end, tokens[i + 1].span.offset - end);
  }
  return text + random_blanks(false);
}

RC_GTEST_PROP(FormatterProperty, KeepsTreesAndCommentsHoweverTheyAreSpaced, ()) {
  static const std::vector<std::string> grammars = known_grammars();
  const std::string source = shaken(*rc::gen::elementOf(grammars));
  RC_PRE(tree(source) != "does not parse");
  const std::string formatted = format(source);
  RC_LOG(source);
  RC_ASSERT(tree(formatted) == tree(source));
  RC_ASSERT(comments(formatted) == comments(source));
  RC_ASSERT(format(formatted) == formatted);
}

std::string body(const std::string& text) { return "grammar g 1\nstart A\nrule A {\n" + text + "}\n"; }

TEST(Formatter, IndentsAndSpaces) {
  EXPECT_EQ(format("grammar g 1 start A attr t in 0 .. - 1 by 0.50=-1\"G/L\" fn f( a ,b )=a ^-b"),
            "grammar g 1\nstart A\nattr t in 0..-1 by 0.50 = -1 \"G/L\"\nfn f(a, b) = a ^ -b\n");
  EXPECT_EQ(format(body("k~uniform( 1,-2 )\n turn(1,0,1)-k turn y-k\nmove( (k) )*scope . x-1\n")),
            body("  k ~ uniform(1, -2)\n  turn (1, 0, 1) -k  turn y -k\n  move ((k)) * scope.x - 1\n"));
  EXPECT_EQ(format(body("emit k>1?cone(top :0.5):box\nfor i in[1,-2]{maybe 1 / 3 spawn B( 2*1/3 )}\n")),
            body("  emit k > 1 ? cone(top: 0.5) : box\n  for i in [1, -2] { maybe 1/3 spawn B(2 * 1 / 3) }\n"));
  EXPECT_EQ(format(body("split y{~ 1:{}repeat 2:{emit box}}\n")),
            body("  split y { ~1: { } repeat 2: { emit box } }\n"));
}

TEST(Formatter, RespectsLinesAndBlankLinesBetweenStatements) {
  const std::string kept = body("  emit box  move y 1\n\n  { emit box }\n  {\n    emit box\n  }\n");
  EXPECT_EQ(format(kept), kept);
  EXPECT_EQ(format(body("\n\nemit box move y 1\n\n\n{emit box}\n{\n\nemit box}\n\n")), kept);
  EXPECT_EQ(format("\n\n\ngrammar g 1\n\n\n\nstart A  rule A { }\n\n\n"), "grammar g 1\n\nstart A\nrule A { }\n");
}

TEST(Formatter, BreaksWhatIsTooLong) {
  const std::string wide(60, 'w'), half(30, 'v'), part(20, 'u');
  EXPECT_EQ(format(body("move y " + wide + " move y " + wide + "\n")),
            body("  move y " + wide + "\n  move y " + wide + "\n"));
  EXPECT_EQ(format(body("for i in 0..1 { move y " + wide + " move y " + half + " }\n")),
            body("  for i in 0..1 {\n    move y " + wide + "\n    move y " + half + "\n  }\n"));
  EXPECT_EQ(format(body("let k = min(" + wide + ", " + part + ") + max(" + half + ", " + part + ")\n")),
            body("  let k = min(" + wide + ", " + part + ") +\n      max(" + half + ", " + part + ")\n"));
  EXPECT_EQ(format(body("maybe 0.5 spawn B(" + wide + ") else detail C(" + half + ")\n")),
            body("  maybe 0.5 spawn B(" + wide + ")\n      else detail C(" + half + ")\n"));
  EXPECT_EQ(format(body("if a { move y " + wide + " } else if b { move y " + half + " }\n")),
            body("  if a {\n    move y " + wide + "\n  } else if b {\n    move y " + half + "\n  }\n"));
  EXPECT_EQ(format(body("choose { 1: { move y " + wide + " } 2: { move y " + half + " } }\n")),
            body("  choose {\n    1: { move y " + wide + " }\n    2: { move y " + half + " }\n  }\n"));
  const std::string word(150, 'n');  // cannot be broken
  EXPECT_EQ(format(body("move y " + word + "\n")), body("  move y " + word + "\n"));
}

TEST(Formatter, KeepsCommentsWhereTheyBelong) {
  EXPECT_EQ(format("# first\n\n#second\ngrammar g 1# name\n  # of A\nstart A #a\n\n\n# rule\nrule A{# in\n# alone\n\n"
                   "emit box# end\n# last\n}# behind\n#the end  \n\n"),
            "# first\n\n#second\ngrammar g 1  # name\n# of A\nstart A  #a\n\n# rule\nrule A {  # in\n  # alone\n\n"
            "  emit box  # end\n  # last\n}  # behind\n#the end\n");
  EXPECT_EQ(format(body("move (1, # x\n2, 3)\nif a { emit box } # yes\nelse { emit box }\n")),
            body("  move (1,  # x\n      2, 3)\n  if a { emit box }  # yes\n  else { emit box }\n"));
}

TEST(Formatter, LinesUpCommentsThatWereLinedUp) {
  EXPECT_EQ(format(body("move y 1       # one\nemit box       # two\n               # goes on\nemit cone # three\n")),
            body("  move y 1  # one\n  emit box  # two\n            # goes on\n  emit cone  # three\n"));
}

TEST(Formatter, LeavesAloneWhatDoesNotParse) {
  Diagnostics diagnostics;
  EXPECT_FALSE(format_grammar("grammar g 1\nrule A {", diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(Formatter, IsFastOnLargeAndDeepTexts) {
  std::string deep, wide;
  for (int i = 0; i < 190; ++i) deep += "{ ";
  for (int i = 0; i < 190; ++i) deep += "} ";
  expect_faithful(body(deep + "\n"));
  for (int i = 0; i < 20'000; ++i) wide += "{ move y 1 # c\n } ";
  expect_faithful(body(wide + "\n"));
  std::string sum = "1";
  for (int i = 0; i < 150; ++i) sum += "+1";
  EXPECT_LE(longest_line(format(body("move y " + sum + "\n"))), kLongestLine);
}

}  // namespace
}  // namespace espalier
