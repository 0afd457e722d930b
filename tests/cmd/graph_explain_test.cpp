// `espalier graph` and `espalier explain` from outside.
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cmd/program_test.h"
#include "render/xml_check.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ChildOptions;
using testing::ChildResult;
using testing::read_text;
using testing::read_xml;
using testing::write_pile;
using testing::write_text;

namespace fs = std::filesystem;

class GraphAndExplain : public testing::ProgramTest {
 protected:
  GraphAndExplain() { write_pile(folder_); }
  void make_samples() {
    ASSERT_EQ(espalier({"sample", "pile.esp", "-n", "1", "--grow", "9", "--out", "s"}).exit_code, 0);
  }
};

TEST_F(GraphAndExplain, GrammarsAreDrawnToAFileOrTheOutput) {
  const ChildResult shown = espalier({"graph", "pile.esp"});
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  const auto doc = read_xml(shown.out);
  EXPECT_EQ(doc.fault, "");
  EXPECT_EQ(doc.texts().count("Block"), 1u);
  const ChildResult written = espalier({"graph", "pile.esp", "-o", "pile.svg"});
  EXPECT_EQ(written.exit_code, 0);
  EXPECT_EQ(written.out, "wrote pile.svg\n");
  EXPECT_EQ(read_text(folder_ / "pile.svg"), shown.out);
}

TEST_F(GraphAndExplain, DerivationsFindTheirGrammar) {
  make_samples();
  const ChildResult shown = espalier({"graph", "s/01.derivation.json"});
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_EQ(read_xml(shown.out).fault, "");
  EXPECT_THAT(shown.out, HasSubstr("k 1."));
  EXPECT_EQ(espalier({"graph", "s/01.derivation.json", "--grammar", "pile.esp"}).out, shown.out);
}

TEST_F(GraphAndExplain, BadInputIsNamed) {
  make_samples();
  write_text(folder_ / "other.esp", "grammar other 1 start A rule A { emit box }");
  write_text(folder_ / "broken.esp", "grammar broken 1 start A rule A {");
  write_text(folder_ / "broken.json", "{}");
  const struct {
    std::vector<std::string> arguments;
    const char* message;
  } cases[] = {
      {{"graph", "none.esp"}, "none.esp"},
      {{"graph", "none.json"}, "none.json"},
      {{"graph", "broken.esp"}, "E0113"},
      {{"graph", "broken.json"}, "does not say which grammar"},
      {{"graph", "scene.toml"}, "scene.toml:1"},
      {{"graph", "pile.esp", "-o", "pile.png"}, "pile.png: graph writes .svg"},
      {{"graph", "pile.esp", "-o", "none/pile.svg"}, "none/pile.svg"},
      {{"graph", "pile.esp", "--grammar", "pile.esp"}, "--grammar"},
      {{"graph", "pile.esp", "-D", "tallest=1"}, "tallest"},
      {{"graph", "s/01.derivation.json", "--grammar", "other.esp"}, "made by \"pile\""},
      {{"explain", "none.esp"}, "none.esp"},
      {{"explain", "broken.esp"}, "E0113"},
      {{"explain", "pile.esp", "--samples", "0"}, "--samples"},
      {{"explain", "pile.esp", "-D", "widest=9"}, "widest"},
  };
  for (const auto& one : cases) {
    const ChildResult result = espalier(one.arguments);
    EXPECT_EQ(result.exit_code, 2) << one.arguments[1];
    EXPECT_THAT(result.err, HasSubstr(one.message));
    EXPECT_THAT(result.out, IsEmpty());
  }
  EXPECT_FALSE(fs::exists(folder_ / "pile.png"));
}

TEST_F(GraphAndExplain, AFullDiskLeavesNothingBehind) {
  ChildOptions options;
  options.most_file_bytes = 512;
  EXPECT_EQ(espalier({"graph", "pile.esp", "-o", "pile.svg"}, options).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "pile.svg"));
}

TEST_F(GraphAndExplain, TheReportFitsATerminal) {
  const ChildResult result = espalier({"explain", "pile.esp", "--samples", "50"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
  // Block: 1 / (1 - 0.9) = 10 genes.
  EXPECT_TRUE(std::regex_search(result.out, std::regex("\nBlock +10 .* 3 optional +Pile, Block\n"))) << result.out;
  EXPECT_THAT(result.out, HasSubstr("11 genes expected"));
  EXPECT_TRUE(std::regex_search(result.out, std::regex("\nwidest +1.4 +1..3 +Widest\n"))) << result.out;
}

TEST_F(GraphAndExplain, TheJsonIsTheSameButForTheTimes) {
  const auto read = [&](const char* seed) {
    const ChildResult result = espalier({"explain", "pile.esp", "--samples", "40", "--seed", seed, "--json"});
    auto json = nlohmann::json::parse(result.out);
    EXPECT_TRUE(json.at("seconds").at("draw").is_number());
    json.erase("seconds");
    return json;
  };
  const auto json = read("1");
  EXPECT_EQ(json, read("1"));
  EXPECT_NE(json.at("sampled"), read("2").at("sampled"));
  EXPECT_NEAR(json.at("expected_genes").get<double>(), 11, 1e-9);
  EXPECT_EQ(json.at("rules").at(1).at("spawned_by"), (std::vector<std::string>{"Pile", "Block"}));
  EXPECT_EQ(json.at("attributes").at(0).at("high"), 3);
}

}  // namespace
}  // namespace espalier
