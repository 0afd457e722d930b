// The gallery shows every shipped grammar, in its own words: script/gallery has been run since they last changed.

#include <filesystem>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "shipped_grammar.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
const fs::path kSource = ESPALIER_SOURCE_DIR;

/// The comment at the head of a grammar, without its marks.
std::string words(const std::string& grammar) {
  std::istringstream lines(grammar);
  std::string text, line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("#")) text += line.substr(line.size() > 1 ? 2 : 1) + "\n";
  return text;
}

TEST(Gallery, ShowsEveryGrammarInItsOwnWords) {
  const std::string page = test::text_of(kSource / "docs/gallery.md");
  std::size_t shown = 0;
  for (const std::string& file : test::shipped_grammars()) {
    SCOPED_TRACE(file);
    const std::string name = fs::path(file).stem(), said = words(test::text_of(test::grammar_folder() / file));
    EXPECT_GT(said.size(), 100u);
    EXPECT_NE(page.find("\n## " + name + "\n"), std::string::npos);
    EXPECT_NE(page.find("\n\n" + said + "\n```sh\nbuild/espalier sample grammars/" + file + " "), std::string::npos)
        << "run script/gallery";
    const fs::path picture = kSource / "docs/pictures/gallery" / (name + ".png");
    ASSERT_TRUE(fs::exists(picture));
    EXPECT_LE(fs::file_size(picture), 400'000u);
    ++shown;
  }
  std::size_t pictures = 0;
  for (std::size_t at = page.find("\n!["); at != std::string::npos; at = page.find("\n![", at + 1)) ++pictures;
  EXPECT_EQ(pictures, shown) << "and no others";
}

}  // namespace
}  // namespace espalier
