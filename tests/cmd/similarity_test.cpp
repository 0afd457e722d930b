// espalier similarity as a person types it.
#include <fmt/format.h>
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
using ::testing::Not;
using testing::box_obj;
using testing::ChildResult;
using testing::read_text;
using testing::write_text;

class SimilarityVerb : public testing::ProgramTest {
 protected:
  SimilarityVerb() {
    write_text(folder_ / "box.obj", box_obj(0, 0, 0, 1, 2, 3));
    write_text(folder_ / "slab.obj", box_obj(0, 0, 0, 1, 0.1, 3));
    write_text(folder_ / "bar.obj", box_obj(0, 0, 0, 9, 1, 1));
  }
};

TEST_F(SimilarityVerb, TellsTwoModels) {
  const ChildResult two = espalier({"similarity", "box.obj", "slab.obj"});
  EXPECT_EQ(two.exit_code, 0) << two.err;
  EXPECT_THAT(two.out, AllOf(HasSubstr("4 x 4 x 4 voxels of each model's own box, 30 pairs of points in each, 10 bins "
                                       "up to its diagonal, seed 1\n"),
                             ContainsRegex("\n *2 +56 +12 +6\\.8 +1 x 0\\.1 x 3 +slab\\.obj\n"),
                             HasSubstr("voxels with surface of both 56, only of 1: 0, only of 2: 0, of neither 8\n"),
                             ContainsRegex("\n1 to 2, all voxels +64 +0\\.[0-9]{3}"),
                             ContainsRegex("\n1 drawn anew, occupied +56 +0\\.[0-9]{3}")));
  EXPECT_THAT(two.err, IsEmpty());
  const ChildResult other = espalier({"similarity", "slab.obj", "box.obj", "--seed", "1", "--threads", "2", "--json"});
  EXPECT_EQ(other.exit_code, 0) << other.err;
  const ChildResult one = espalier({"similarity", "slab.obj", "box.obj", "--threads", "1", "--json"});
  EXPECT_EQ(other.out, one.out);
  const auto json = nlohmann::json::parse(one.out);
  EXPECT_THAT(two.out, HasSubstr(fmt::format("{:.3f}", json["pairs"][0]["occupied"]["mean"].get<double>())));
}

TEST_F(SimilarityVerb, OptionsReachTheDescriptor) {
  const ChildResult result =
      espalier({"similarity", "box.obj", "slab.obj", "--grid", "2", "--pairs", "70", "--bins", "5", "--range", "1.5",
                "--box", "shared", "--seed", "12", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["settings"], nlohmann::json({{"grid", 2}, {"pairs", 70}, {"bins", 5}, {"range", 1.5},
                                              {"box", "shared"}, {"seed", 12}}));
  EXPECT_EQ(json["distances"].size(), 8u);
  EXPECT_EQ(json["pairs"][0]["voxels"]["only_first"], 4) << "the slab fills the lower half of the shared box";
}

TEST_F(SimilarityVerb, TellsMoreAsAMatrix) {
  const ChildResult three =
      espalier({"similarity", "box.obj", "slab.obj", "bar.obj", "--over", "occupied", "--csv", "m.csv"});
  EXPECT_EQ(three.exit_code, 0) << three.err;
  EXPECT_THAT(three.out, AllOf(HasSubstr("medians over occupied voxels"), ContainsRegex("\n +1 +2 +3 +anew\n1 +- "),
                               ContainsRegex("\n3 +0\\.[0-9]{3} +0\\.[0-9]{3} +- +0\\.[0-9]{3}\n"),
                               HasSubstr("wrote m.csv")));
  EXPECT_TRUE(read_text(folder_ / "m.csv").starts_with("model,box.obj,slab.obj,bar.obj\nbox.obj,0,"));
  std::vector<std::string> many = {"similarity"};
  for (int i = 0; i < 14; ++i) many.push_back(i % 2 ? "box.obj" : "slab.obj");
  const ChildResult wide = espalier(many);
  EXPECT_EQ(wide.exit_code, 0) << wide.err;
  EXPECT_THAT(wide.out, ContainsRegex("\n +13 +14 +anew\n"));
  std::istringstream lines(wide.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110u) << line;
}

TEST_F(SimilarityVerb, TakesRunsSamplesAndPictures) {
  write_pile(folder_);
  ASSERT_EQ(espalier({"run", "scene.toml", "--out", "made"}).exit_code, 0);
  const ChildResult same = espalier({"similarity", "made", "made/best.png", "--json"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(nlohmann::json::parse(same.out)["pairs"][0]["all"]["most"], 0);
  EXPECT_EQ(espalier({"similarity", "made", "meshes/tower.obj", "made/best.obj", "made/best.glb"}).exit_code, 0);
  const ChildResult adapted = espalier({"similarity", "made", "box.obj", "-D", "widest=2"});
  EXPECT_EQ(adapted.exit_code, 0) << adapted.err;
  EXPECT_EQ(espalier({"similarity", "made", "box.obj", "-D", "widets=2"}).exit_code, 2);
  EXPECT_EQ(espalier({"similarity", "made/best.derivation.json", "box.obj", "--grammar", "pile.esp"}).exit_code, 0);
  ASSERT_EQ(espalier({"sample", "pile.esp", "-n", "2", "--out", "s"}).exit_code, 0);
  EXPECT_EQ(espalier({"similarity", "s/01.derivation.json", "s/02.glb"}).exit_code, 0);
  EXPECT_THAT(espalier({"similarity", "s", "box.obj"}).err, HasSubstr("name one of its files"));
}

TEST_F(SimilarityVerb, TheExampleOfTheDocsIsTrue) {
  for (const char* steps : {"20", "40"}) {
    const ChildResult sample =
        espalier({"sample", std::string(ESPALIER_SOURCE_DIR) + "/grammars/guided-tree.esp", "-n", "1", "--grow", steps,
                  "--seed", "3", "--out", std::string("out/grown-") + steps});
    ASSERT_EQ(sample.exit_code, 0) << sample.err;
  }
  const ChildResult result = espalier({"similarity", "out/grown-20/01.derivation.json", "out/grown-40/01.glb",
                                       "--pairs", "1000", "--box", "shared"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string page = read_text(std::string(ESPALIER_SOURCE_DIR) + "/docs/tools.md");
  EXPECT_NE(page.find("```text\n" + result.out + "```"), page.npos) << result.out;
}

TEST_F(SimilarityVerb, SaysWhatShowsNothing) {
  write_text(folder_ / "none.esp", "grammar none 1\nstart S\nrule S { bone (0, 0, 0) -> (0, 1, 0) }\n");
  ASSERT_EQ(espalier({"sample", "none.esp", "-n", "1", "--out", "s"}).exit_code, 0);
  const ChildResult result = espalier({"similarity", "box.obj", "s/01.derivation.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("warning: s/01.derivation.json: shows nothing; every voxel is empty"));
  EXPECT_THAT(result.out, HasSubstr("only of 1: 56"));
}

TEST_F(SimilarityVerb, BadInputExitsWithTwoAndSaysWhy) {
  write_text(folder_ / "bad.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
      {{}, "models"},
      {{"box.obj"}, "similarity compares from 2 to 256 models, got 1"},
      {{"box.obj", "none.obj"}, "none.obj"},
      {{"bad.obj", "box.obj"}, "bad.obj: a coordinate is not finite"},
      {{"box.obj", "slab.obj", "--grid", "0"}, "grid must be from 1 to 16, got 0"},
      {{"box.obj", "slab.obj", "--pairs", "100001"}, "pairs must be from 1 to 100000, got 100001"},
      {{"box.obj", "slab.obj", "--pairs", "-1"}, "--pairs"},
      {{"box.obj", "slab.obj", "--bins", "101"}, "bins must be from 2 to 100, got 101"},
      {{"box.obj", "slab.obj", "--range", "0"}, "range must be from 1e-09 to 1000000000 m, got 0"},
      {{"box.obj", "slab.obj", "--range", "nan"}, "range must be from"},
      {{"box.obj", "slab.obj", "--box", "mine"}, "--box must be own or shared, got \"mine\""},
      {{"box.obj", "slab.obj", "--over", "some"}, "--over must be all or occupied, got \"some\""},
      {{"box.obj", "slab.obj", "--csv", ""}, "--csv"},
      {{"box.obj", "slab.obj", "--csv", "box.obj/m.csv"}, "box.obj/m.csv"},
      {{"box.obj", "slab.obj", "-D", "a=1"}, "-D goes with derivations"},
      {{"box.obj", "slab.obj", "--dance"}, "--dance"},
  };
  for (const auto& [arguments, message] : bad) {
    std::vector<std::string> words = {"similarity"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const ChildResult result = espalier(words);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.err + result.out, HasSubstr(message));
    EXPECT_THAT(result.out, Not(HasSubstr("distance"))) << message;
  }
}

}  // namespace
}  // namespace espalier
