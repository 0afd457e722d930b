// Importing L-systems: what is read, what is refused, and what the written grammar looks like. What it grows is held
// against a turtle in tests/model/lsystem_test.cpp.

#include "grammar/lsystem.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grammar/compiler.h"
#include "grammar/fences.h"
#include "grammar/formatter.h"
#include "grammar/lsystem_import.h"

namespace espalier {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

lsystem::System parsed(const std::string& source) {
  Diagnostics diagnostics;
  const auto system = lsystem::parse(source, diagnostics);
  EXPECT_TRUE(system) << render(diagnostics, "test", source);
  return system ? *system : lsystem::System{};
}

std::string imported(const std::string& source) {
  Diagnostics diagnostics;
  const auto text = import_lsystem(source, {"test", "test.lsys", {}}, diagnostics);
  return text ? *text : render(diagnostics, "test", source);
}

/// "CODE line:column" of each error.
std::vector<std::string> faults(const std::string& source) {
  Diagnostics diagnostics;
  import_lsystem(source, {"test", "test.lsys", {}}, diagnostics);
  std::vector<std::string> result;
  for (const Diagnostic& d : diagnostics.items())
    result.push_back(fmt::format("{} {}:{}", d.code, d.span.line, d.span.column));
  return result;
}

TEST(LSystemParser, ReadsProductionsHoweverTheyAreWritten) {
  const lsystem::System system = parsed(
      "axiom: A(1) B\n"
      "p1: A(l) : l > 0.1 -> F(l)[+A(l * 0.7)] : 0.5\n"
      "A(x) -(0.5)-> f\n"
      "A(q) : * -> F\n"
      "B -> AA   # not this\n"
      "C=F+F\n"
      "D \xe2\x86\x92 F\n"
      "E -> F [+ F]   // nor this\n"
      "   [- F] FF//F\n"
      "p9 : G -> F\n");
  ASSERT_EQ(system.productions.size(), 8u);
  EXPECT_TRUE(system.productions[0].guard && system.productions[0].probability);
  EXPECT_THAT(system.productions[1].params, ElementsAre("l")) << "productions of a symbol share their parameters";
  EXPECT_EQ(system.productions[1].probability->value, 0.5);
  EXPECT_FALSE(system.productions[2].guard);
  EXPECT_EQ(system.productions[3].successor.size(), 2u);
  EXPECT_EQ(system.productions[6].successor.size(), 14u);
  EXPECT_EQ(system.productions[7].symbol, "G");
}

TEST(LSystemParser, ReadsSettingsAndConstants) {
  const lsystem::System system = parsed(
      "#define r 0.5\nconst long = 2 * r\nshort = long ^ 2 / 4\niterations: 7\nangle: 90 * r\nstep: long\nwidth = 0.2\n"
      "thinner: 0.9\ndraw: G H\nmove: g\naxiom: GF\n");
  EXPECT_EQ(system.constants.size(), 3u);
  EXPECT_EQ(system.constants[2].number, 0.25);
  EXPECT_EQ(system.iterations, 7);
  EXPECT_EQ(system.angle, 45);
  EXPECT_EQ(system.step, 1);
  EXPECT_EQ(system.width, 0.2);
  EXPECT_EQ(system.draw, "FGH");
  EXPECT_EQ(system.move, "fg");
}

TEST(LSystemImport, RefusesWhatHasNoMeaningHere) {
  for (const char* symbol : {"$", "{", "}", ".", "'", "~", "%", "?", "@", "<"})
    EXPECT_THAT(faults(fmt::format("axiom: F{}F\n", symbol)), ElementsAre("L0201 1:9")) << symbol;
  EXPECT_THAT(imported("axiom: F$F\n"), HasSubstr("aim z toward"));
  EXPECT_THAT(imported("axiom: F{+F.}\n"), HasSubstr("emit leaf"));
  EXPECT_THAT(imported("axiom: F\nA < B > C -> F\n"), HasSubstr("parameter"));
}

TEST(LSystemImport, RefusesContexts) {
  EXPECT_THAT(faults("axiom: F\nA < B > C -> F\n"), ElementsAre("L0201 2:3"));
  EXPECT_THAT(faults("axiom: F\np1: A(x) < B(y) : x > y -> F\n"), ElementsAre("L0201 2:10"));
  EXPECT_THAT(faults("axiom: F\nB > C : 1 > 0 -> F\n"), ElementsAre("L0201 2:3"));
}

TEST(LSystemImport, RefusesWhatCannotBeFollowed) {
  EXPECT_THAT(faults("axiom: X\nX -> F[+X]FXF : 0.5\nX -> FXFF : 0.5\n"), ElementsAre()) << "both end at one place";
  // What follows X has to know where X ends, and that is a matter of chance.
  EXPECT_THAT(faults("axiom: X\nX -> F[+X]FXF : 0.5\nX -> FXF : 0.5\n"), ElementsAre("L0203 2:12", "L0203 3:7"));
  EXPECT_THAT(faults("axiom: A(1)\niterations: 5\nA(l) : l > 0.5 -> F(l)A(l * 0.7)F(l)[A(l * 0.9)]\n"),
              ElementsAre("L0203 3:23"));
  EXPECT_THAT(faults("axiom: F+F\n+ -> F+\n"), ElementsAre("L0204 2:1"));
  EXPECT_THAT(faults("axiom: XY\n"), ElementsAre("L0205 1:8"));
  EXPECT_THAT(faults("axiom: A\nA -> F : 0 - 1\nA -> FF : 2\n"), ElementsAre("L0206 2:1"));
}

// Where a module ends is found by following it: here through 2^40 modules, which has to be given up.
TEST(LSystemImport, GivesUpOnWhatGrowsTooFast) {
  EXPECT_THAT(faults("axiom: AF\niterations: 40\nA -> B(1)\nB(x) -> B(x + 1)B(2 * x)\n"), ElementsAre("L0203 1:8"));
  EXPECT_THAT(faults("axiom: " + std::string(250'000, 'F') + "\n"), ElementsAre("L0103 1:20008"));
}

TEST(LSystemImport, PointsAtMistakes) {
  EXPECT_THAT(faults(""), ElementsAre("L0106 0:0"));
  EXPECT_THAT(faults("axiom: F[+F\n"), ElementsAre("L0101 1:9"));
  EXPECT_THAT(faults("axiom: F]\naxoim: F\nstep: 0\n"), ElementsAre("L0101 1:9", "L0101 2:1", "L0102 3:7"));
  EXPECT_THAT(faults("axiom: F(l)\nA(l) -> F(m)\nA(l, l) -> F\n"), ElementsAre("L0105 3:6"));
  EXPECT_THAT(faults("axiom: F(l)\nA(l) -> F(m)\n"), ElementsAre("L0107 1:10", "L0107 2:11"));
  EXPECT_THAT(faults("axiom: F(1 +)\n"), ElementsAre("L0101 1:13"));
  EXPECT_THAT(faults("axiom: F(sin(2))\n"), ElementsAre("L0104 1:10"));
  EXPECT_THAT(faults("axiom: F\nconst a = 1 / 0\n"), ElementsAre("L0102 2:7"));
  EXPECT_THAT(faults("axiom: F\nA -(0.5)-> F : 0.5\n"), ElementsAre("L0105 2:16"));
  EXPECT_THAT(faults("axiom: F(1 < 2)\nA(l) : l -> F(2 * !l)\nA(l) : l > 0 && 1 -> F : l > 2\n"),
              ElementsAre("L0108 1:10", "L0108 2:8", "L0108 2:19", "L0108 3:17", "L0108 3:26"));
  EXPECT_THAT(faults("axiom: F\niterations: 2.5\n"), ElementsAre("L0102 2:1"));
  EXPECT_THAT(faults("axiom: F\naxiom: F\n"), ElementsAre("L0106 2:1"));
  EXPECT_THAT(faults("axiom: F\nA -> F\n  [+F]\n  $\n"), ElementsAre("L0201 4:3"));
}

TEST(LSystemImport, HasBudgets) {
  const auto code = [](const std::string& source) {
    const std::vector<std::string> all = faults(source);
    return all.empty() ? "none" : all[0].substr(0, 5);
  };
  const auto times = [](const std::string& text, int n) {
    std::string all;
    for (int i = 0; i < n; ++i) all += text;
    return all;
  };
  EXPECT_EQ(code("axiom: F\n# " + std::string(lsystem::kLargestFile, 'x')), "L0103");
  EXPECT_EQ(code("axiom: F\n" + times("A -> F\n", 501)), "L0103");
  EXPECT_EQ(code("axiom: " + times("F", 20'001) + "\n"), "L0103");
  EXPECT_EQ(code("axiom: " + times("[", 61) + "F" + times("]", 61) + "\n"), "L0103");
  EXPECT_EQ(code("axiom: " + times("[", 60) + "F" + times("]", 60) + "\n"), "none");
  EXPECT_EQ(code("axiom: F(" + times("(", 100'000) + "\n"), "L0103");
  EXPECT_EQ(code("axiom: F(" + times("-", 100'000) + "\n"), "L0103");
  EXPECT_EQ(code("axiom: F(1" + times("+1", 100) + ")\n"), "L0103");
  EXPECT_EQ(code("const " + std::string(41, 'a') + " = 1\naxiom: F\n"), "L0103");
  EXPECT_EQ(code("axiom: F\niterations: 41\n"), "L0102");
  EXPECT_EQ(code("axiom: F(1" + times(",1", 16) + ")\n"), "L0103");
}

TEST(LSystemImport, WritesGrammarsThatCompileAndAreFormatted) {
  const auto files = testing::files_in("tests/grammar/lsystems", ".lsys");
  ASSERT_GE(files.size(), 10u);
  for (const auto& path : files) {
    const std::string text = imported(testing::text_of(path));
    const CompileResult compiled = compile_grammar({"test.esp", text, {}});
    EXPECT_TRUE(compiled.graph && compiled.diagnostics.items().empty())
        << path << "\n" << render(compiled.diagnostics, "test.esp", text);
    Diagnostics none;
    EXPECT_EQ(format_grammar(text, none), text) << path;
  }
}

TEST(LSystemImport, KeepsClearOfTakenNames) {
  const std::string text = imported(
      "const iterations = 2\nconst scope = 3\nconst F = 1\nconst A = 0.5\naxiom: xA(1)\niterations: 3\n"
      "x -> F(scope)x\nA(left) : left > A -> F(left * iterations * F)[+A(left * 0.7)][-A(left * 0.9)]\n");
  const CompileResult compiled = compile_grammar({"test.esp", text, {}});
  EXPECT_TRUE(compiled.graph) << render(compiled.diagnostics, "test.esp", text);
}

TEST(LSystemImport, LeavesDecisionsToTheSearch) {
  const std::string text = imported("axiom: X\nX -> F[+X] : 0.25\nX -> FX : 0.75\nX -> FFF : 0\n");
  EXPECT_THAT(text, HasSubstr("choose {\n    0.25: {"));
  EXPECT_THAT(text, HasSubstr("    0.75: {"));
  EXPECT_THAT(text, Not(HasSubstr("    0: {")));
  EXPECT_THAT(text, HasSubstr("attr turn_angle in 0deg..180deg = 90deg \"Turtle/Angle\""));
}

TEST(LSystemImport, TellsWhatBecameADetail) {
  const std::string text = imported("axiom: A(1)\niterations: 8\nA(l) : l > 0.2 -> F(l)[+A(l * 0.7)][-A(l * 0.5)]\n");
  EXPECT_THAT(text, HasSubstr("# Symbols that decide by their parameters"));
  EXPECT_THAT(text, HasSubstr("detail A(left, l) {\n  if left > 0 and l > 0.2 {"));
}

}  // namespace
}  // namespace espalier
