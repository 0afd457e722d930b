// Every example of the documentation grows: it compiles without a word, and its samples are models.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "derivation/encode.h"
#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "model/expand.h"

namespace espalier {
namespace {

struct Example {
  std::filesystem::path page;
  std::size_t line = 0;
  std::string text;
};

std::vector<Example> examples() {
  std::vector<Example> found;
  for (const auto& entry : std::filesystem::directory_iterator(ESPALIER_SOURCE_DIR "/docs")) {
    if (entry.path().extension() != ".md") continue;
    std::ifstream page(entry.path());
    bool inside = false;
    std::size_t number = 0;
    for (std::string line; std::getline(page, line);) {
      ++number;
      if (inside && line == "```") inside = false;
      else if (inside) found.back().text += line + "\n";
      else if (line == "```esp") inside = true, found.push_back({entry.path().filename(), number + 1, {}});
    }
  }
  return found;
}

TEST(DocsExamples, AllGrow) {
  const std::vector<Example> all = examples();
  ASSERT_GE(all.size(), 22u);
  for (const Example& example : all) {
    SCOPED_TRACE(example.page.string() + ", line " + std::to_string(example.line));
    const CompileResult result = compile_grammar({"example", example.text});
    ASSERT_TRUE(result.graph && result.diagnostics.items().empty()) << render(result.diagnostics, result.sources);
    std::size_t most = 0;
    for (std::uint32_t i = 0; i < 10; ++i) {
      RandomStream random({1, Purpose::test, 0, i});
      const Derivation derivation = sample(*result.graph, random, 2000).derivation;
      EXPECT_EQ(find_fault(*result.graph, derivation), "");
      Model model;
      Expander(*result.graph).expand(derivation, ExpandTo::full, model);
      EXPECT_EQ(model.dropped, 0u);
      most = std::max(most, model.instances.size());
    }
    EXPECT_GT(most, 0u) << "it shows nothing";
  }
}

}  // namespace
}  // namespace espalier
