// Every ```esp fence of docs/*.md is a complete grammar that checks without errors and warnings.

#include <gtest/gtest.h>

#include "grammar/checker.h"
#include "grammar/fences.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

TEST(Docs, EveryExampleOfEveryPageChecks) {
  const std::vector<testing::Fence> examples = testing::all_fences();
  std::size_t of_the_language = 0;
  for (const testing::Fence& example : examples) {
    of_the_language += example.page == "language.md";
    Diagnostics diagnostics;
    const auto checked = check(parse(example.text, diagnostics), {}, diagnostics);
    EXPECT_TRUE(checked && diagnostics.items().empty()) << "docs/" << example.page << ", line " << example.line << "\n"
                                                        << render(diagnostics, "example", example.text);
  }
  EXPECT_GE(of_the_language, 20u);
}

}  // namespace
}  // namespace espalier
