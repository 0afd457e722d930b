// espalier breed as a person types it.
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cmd/program_test.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ChildResult;
using testing::read_text;
using testing::read_tree;

class BreedVerb : public testing::ProgramTest {
 protected:
  const std::string grammar_ = std::string(ESPALIER_SOURCE_DIR) + "/grammars/gentree.esp";
  bool exists(const std::string& name) { return std::filesystem::exists(folder_ / name); }
};

TEST_F(BreedVerb, MakesKindsOfAGrammarThenSiblingsOfOneOfThem) {
  const ChildResult kinds = espalier({"breed", "--from", grammar_, "--count", "4", "--max-triangles", "5000", "--out", "kinds"});
  ASSERT_EQ(kinds.exit_code, 0) << kinds.err;
  EXPECT_THAT(kinds.err, IsEmpty());
  EXPECT_THAT(kinds.out, AllOf(HasSubstr("4 of 4 found among "), ContainsRegex("wrote 4 to kinds, at most [0-9]+ triangles each")));
  const ChildResult siblings = espalier({"breed", "--from", "kinds/003.glb", "-n", "3", "--out", "siblings", "--threads", "1"});
  ASSERT_EQ(siblings.exit_code, 0) << siblings.err;
  const auto index = nlohmann::json::parse(read_text(folder_ / "siblings/species.json"));
  EXPECT_EQ(index["from"], "inputs/start/003.derivation.json");
  // A file of the pack is a model like any other.
  const ChildResult shown = espalier({"inspect", "siblings/002.glb"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_EQ(espalier({"export", "siblings/002.derivation.json", "-o", "again.stl"}).exit_code, 0);
  EXPECT_TRUE(exists("again.stl"));
}

TEST_F(BreedVerb, TheCommandOfTheIndexMakesTheSameBytesWithAnyNumberOfThreads) {
  ASSERT_EQ(espalier({"breed", "--from", grammar_, "-n", "2", "--lods", "--joints", "smooth", "--out", "one"}).exit_code, 0);
  const auto index = nlohmann::json::parse(read_text(folder_ / "one/species.json"));
  const std::string command = index["make_again"];
  ASSERT_THAT(command, AllOf(HasSubstr("espalier breed --from inputs/gentree.esp"), HasSubstr(" --lods"), HasSubstr(" --out OUT")));
  std::vector<std::string> words;
  std::istringstream line(command.substr(command.find(' ') + 1, command.rfind(' ') - command.find(' ') - 1));
  for (std::string word; line >> word;) words.push_back(word == "inputs/gentree.esp" ? "one/" + word : word);
  words.insert(words.end(), {"again", "--threads", "2"});
  const ChildResult again = espalier(words);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_tree(folder_ / "one"), read_tree(folder_ / "again"));
  EXPECT_TRUE(exists("one/002-lod3.glb"));
}

TEST_F(BreedVerb, SaysWhatIsWrongAndWritesNothing) {
  const auto refused = [&](std::vector<std::string> more, const std::string& why) {
    std::vector<std::string> words = {"breed", "--from", grammar_, "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    const ChildResult result = espalier(words);
    EXPECT_NE(result.exit_code, 0) << why;
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_FALSE(exists("out")) << why;
  };
  refused({"--max-triangles", "1", "-n", "1"}, "fewer than 1: allow more triangles");
  refused({"--format", "max"}, "--format must be glb, obj, ply or stl, got \"max\"");
  refused({"--lod", "1", "--lods"}, "--lod and --lods exclude each other");
  refused({"--lod", "4"}, "--lod must be from 0 to 3, got 4");
  refused({"--count", "0"}, "0");
  refused({"-D", "leafy=perhaps"}, "leafy");
  EXPECT_NE(espalier({"breed", "--from", "no-such.derivation.json", "--out", "out"}).exit_code, 0);
}

}  // namespace
}  // namespace espalier
