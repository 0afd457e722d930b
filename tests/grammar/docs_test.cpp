// Every ```esp fence of docs/language.md is a complete grammar that checks without errors and warnings.

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "grammar/checker.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

struct Fence {
  int line = 0;
  std::string text;
};

std::vector<Fence> fences(const std::filesystem::path& page) {
  std::ifstream in(page);
  std::vector<Fence> result;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!inside && line == "```esp") result.push_back({number, ""});
    else if (inside && line != "```") result.back().text += line + "\n";
    if (line == "```esp") inside = true;
    else if (line == "```") inside = false;
  }
  return result;
}

TEST(Docs, EveryExampleOfTheLanguagePageChecks) {
  const std::vector<Fence> examples = fences(std::filesystem::path(ESPALIER_SOURCE_DIR) / "docs" / "language.md");
  ASSERT_GE(examples.size(), 20u);
  for (const Fence& example : examples) {
    Diagnostics diagnostics;
    const auto checked = check(parse(example.text, diagnostics), {}, diagnostics);
    EXPECT_TRUE(checked && diagnostics.items().empty()) << "docs/language.md, line " << example.line << "\n"
                                                        << render(diagnostics, "example", example.text);
  }
}

}  // namespace
}  // namespace espalier
