#include "run/find_grammar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"
#include "derivation/encode.h"
#include "derivation/sample.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/fixtures.h"
#include "run/sample.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_text;

constexpr const char* kGrammar = "grammar two_words 1\nattr widest in 1..3 = 2 \"Widest\"\nstart A\n"
                                 "rule A { k ~ uniform(1, 2) resize vec(k * widest) emit box }\n";

class FindGrammar : public ::testing::Test {
 protected:
  /// A derivation of the grammar in the file, as `encode` gives it: it says nothing of settings.
  void write_derivation(const std::string& path, const std::map<std::string, std::string>& attributes = {}) {
    const LoadedGrammar grammar = load_grammar(folder_ / "grammar.esp", attributes);
    RandomStream random({4, Purpose::test, 0, 0});
    write_text(folder_ / path, encode(*grammar.graph, sample(*grammar.graph, random).derivation));
  }
  void SetUp() override { write_text(folder_ / "grammar.esp", kGrammar); }
  std::string error_of(const std::string& path) {
    try {
      load_derivation(folder_ / path, "", {});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(FindGrammar, LooksBesideTheFileAndAboveAndForBothSpellings) {
  write_derivation("trees/young/a.derivation.json");
  for (const char* place : {"trees/young/two_words.esp", "trees/young/two-words.esp", "trees/two_words.esp",
                            "trees/two-words.esp"}) {
    EXPECT_THAT(error_of("trees/young/a.derivation.json"),
                AllOf(HasSubstr("trees/young/two_words.esp"), HasSubstr("trees/two-words.esp"), HasSubstr("--grammar")));
    write_text(folder_ / place, kGrammar);
    const LoadedDerivation loaded = load_derivation(folder_ / "trees/young/a.derivation.json", "", {});
    EXPECT_EQ(loaded.grammar.path, folder_ / place);
    std::filesystem::remove(folder_ / place);
  }
  write_text(folder_ / "two_words.esp", kGrammar);
  EXPECT_NE(error_of("trees/young/a.derivation.json"), "") << "two folders above is too far";
}

TEST_F(FindGrammar, TakesNoOtherTextOfTheGrammar) {
  write_derivation("a.derivation.json");
  write_text(folder_ / "two_words.esp", std::string(kGrammar) + "rule B { emit sphere }\n");
  EXPECT_THAT(error_of("a.derivation.json"), HasSubstr("two_words.esp (another text)"));
  write_text(folder_ / "two_words.esp", "grammar two_words 1\n");
  EXPECT_THAT(error_of("a.derivation.json"), HasSubstr("two_words.esp (another text)"));
  write_text(folder_ / "two-words.esp", kGrammar);
  EXPECT_EQ(error_of("a.derivation.json"), "");
}

TEST_F(FindGrammar, HeedsAttributes) {
  write_text(folder_ / "two_words.esp", kGrammar);
  write_derivation("plain.derivation.json");
  EXPECT_EQ(load_derivation(folder_ / "plain.derivation.json", "", {{"widest", "3"}}).grammar.attributes.at("widest"), "3");
  write_derivation("large.derivation.json", {{"widest", "3"}});
  EXPECT_THAT(error_of("large.derivation.json"), HasSubstr("another text"));
  EXPECT_EQ(load_derivation(folder_ / "large.derivation.json", "", {{"widest", "3"}}).derivation.size(), 1u);
}

TEST_F(FindGrammar, HelpsDerivationsThatWereTakenOutOfTheirFolder) {
  SampleRequest request;
  request.grammar = folder_ / "grammar.esp", request.attributes = {{"widest", "1.5"}}, request.count = 1;
  AssimpMeshSource source;
  write_samples(request, folder_ / "samples", source, *make_serial_executor(), SampleFiles::genes);
  write_text(folder_ / "kept/tree.derivation.json", read_text(folder_ / "samples/01.derivation.json"));
  EXPECT_THAT(error_of("kept/tree.derivation.json"), AllOf(HasSubstr("kept/inputs/grammar.esp"), HasSubstr("kept/two_words.esp")));
  write_text(folder_ / "kept/two_words.esp", kGrammar);
  const LoadedDerivation loaded = load_derivation(folder_ / "kept/tree.derivation.json", "", {});
  EXPECT_EQ(loaded.grammar.attributes.at("widest"), "1.5");
}

TEST_F(FindGrammar, ReadsNoNameThatIsAPath) {
  write_derivation("a.derivation.json");
  std::string text = read_text(folder_ / "a.derivation.json");
  text.replace(text.find("two_words"), 9, "../grammar");
  write_text(folder_ / "b.derivation.json", text);
  EXPECT_THAT(error_of("b.derivation.json"), HasSubstr("does not say which grammar"));
}

}  // namespace
}  // namespace espalier
