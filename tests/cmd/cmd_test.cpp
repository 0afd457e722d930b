// The program from outside: exit codes, messages, folders, signals, full disks.
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
using testing::ChildOptions;
using testing::ChildResult;
using testing::pile_scene;
using testing::read_text;
using testing::read_tree;
using testing::write_pile;
using testing::write_text;

namespace fs = std::filesystem;

class Cmd : public testing::ProgramTest {
 protected:
  Cmd() { write_pile(folder_); }

  /// What lies in the folder beside the three files of the scene.
  std::vector<std::string> leftovers() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (name != "pile.esp" && name != "meshes" && name != "scene.toml") names.push_back(name);
    }
    return names;
  }
};

TEST_F(Cmd, HelpAndVersionSucceed) {
  const ChildResult help = espalier({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* verb : {"check", "sample", "run", "score", "inspect", "reproduce", "export", "render", "graph",
                           "explain", "preview", "compare", "sweep", "similarity"}) {
    EXPECT_THAT(help.out, HasSubstr(std::string("espalier ") + verb)) << "an example, or the list of verbs";
    EXPECT_EQ(espalier({verb, "--help"}).exit_code, 0) << verb;
  }
  const ChildResult version = espalier({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, ContainsRegex("^espalier [0-9]+\\.[0-9]+\\.[0-9]+\n$"));
}

TEST_F(Cmd, WrongUsageIsBadInput) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {}, {"dance"}, {"run"}, {"run", "scene.toml", "--dance"}, {"run", "scene.toml", "--seed", "-1"},
           {"sample", "pile.esp", "-n", "0"}, {"score", "scene.toml"}, {"export", "x.json"}}) {
    const ChildResult result = espalier(arguments);
    EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(arguments);
    EXPECT_FALSE(result.err.empty()) << ::testing::PrintToString(arguments);
  }
  EXPECT_THAT(leftovers(), IsEmpty());
}

TEST_F(Cmd, CheckSaysWhatIsWrong) {
  const ChildResult good = espalier({"check", "pile.esp"});
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_THAT(good.out, HasSubstr("pile is well-formed: 2 rules"));
  write_text(folder_ / "bad.esp", "grammar bad 1\nstart S\nrule S { emit nothing }\n");
  const ChildResult bad = espalier({"check", "bad.esp"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.out, AllOf(HasSubstr("bad.esp:3:"), HasSubstr("error["), HasSubstr("^")));
  const ChildResult json = espalier({"check", "bad.esp", "--json"});
  EXPECT_EQ(json.exit_code, 2);
  const auto document = nlohmann::json::parse(json.out);
  EXPECT_GE(document["errors"], 1);
  EXPECT_EQ(document["diagnostics"][0]["line"], 3);
  EXPECT_EQ(espalier({"check", "none.esp"}).exit_code, 2);
  EXPECT_EQ(espalier({"check", "pile.esp", "-D", "widest=2"}).exit_code, 0);
  EXPECT_EQ(espalier({"check", "pile.esp", "-D", "widets=2"}).exit_code, 2);
}

TEST_F(Cmd, RunPrintsItsEndAndNamesItsFiles) {
  const ChildResult run = espalier({"run", "scene.toml", "--out", "made", "--threads", "1"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto result = nlohmann::json::parse(read_text(folder_ / "made/result.json"));
  EXPECT_THAT(run.out, AllOf(HasSubstr("score "), HasSubstr(" of at most "), HasSubstr(" %): "),
                             HasSubstr(result["words"].get<std::string>()), HasSubstr("wrote made/best.glb"),
                             HasSubstr("ended by generations"), Not(HasSubstr("\r"))));
  EXPECT_THAT(leftovers(), ::testing::ElementsAre("made"));
}

TEST_F(Cmd, RunPutsItsFolderBelowOutUnlessTold) {
  EXPECT_EQ(espalier({"run", "scene.toml"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/scene/best.glb"));
}

TEST_F(Cmd, OptionsOfRunReachTheSettings) {
  const ChildResult run = espalier({"run", "scene.toml", "--out", "made", "--seed", "11", "--evaluations", "40",
                                    "--keep", "1", "--set", "search.mutation=0.9", "-D", "widest=2", "--engine", "ga"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(read_text(folder_ / "made/run.toml"),
              AllOf(HasSubstr("seed = 11\n"), HasSubstr("evaluations = 40\n"), Not(HasSubstr("generations =")),
                    HasSubstr("keep = 1\n"), HasSubstr("mutation = 0.9\n"), HasSubstr("\"widest\" = \"2\"")));
  EXPECT_EQ(nlohmann::json::parse(read_text(folder_ / "made/result.json"))["stopped_by"], "evaluations");
}

TEST_F(Cmd, JsonEventsAreOneObjectPerLine) {
  const ChildResult run = espalier({"run", "scene.toml", "--out", "made", "--json"});
  EXPECT_EQ(run.exit_code, 0);
  std::istringstream lines(run.out);
  std::vector<std::string> events;
  for (std::string line; std::getline(lines, line);) events.push_back(nlohmann::json::parse(line)["event"]);
  std::vector<std::string> expected = {"started"};
  for (int step = 0; step < 6; ++step) expected.insert(expected.end(), {"step", "gauges"});
  expected.insert(expected.end(), {"writing", "finished"});
  EXPECT_EQ(events, expected);
}

TEST_F(Cmd, BadScenesExitWithTwoAndLeaveNothing) {
  const std::string good = pile_scene();
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"", "espalier must be 1"},
      {good.substr(0, good.size() / 2), "scene.toml"},
      {std::string("\0\0\0", 3), "binary"},
      {good + "[search]\n", "scene.toml:"},
      {good + "[serach]\na = 1\n", "did you mean search?"},
      {std::string(good).replace(good.find("24"), 2, "-1"), "search.population must be"},
      {std::string(good).replace(good.find("0.5"), 3, "nan"), "volume.overlap_weight must be a number"},
      {std::string(good).replace(good.find("tower"), 5, "power"), "power.obj"},
      {std::string(good).replace(good.find("pile"), 4, "mile"), "mile.esp"},
  };
  for (const auto& [text, message] : bad) {
    write_text(folder_ / "scene.toml", text);
    const ChildResult run = espalier({"run", "scene.toml", "--out", "made"});
    EXPECT_EQ(run.exit_code, 2) << message;
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_THAT(leftovers(), IsEmpty()) << message;
  }
}

TEST_F(Cmd, BadInputsExitWithTwoAndLeaveNothing) {
  const std::string box = testing::box_obj(0, 0, 0, 1, 1, 1);
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"meshes/tower.obj", ""},
      {"meshes/tower.obj", box.substr(0, 30)},
      {"meshes/tower.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"meshes/tower.obj", std::string("\xff\xfe\x00\x01", 4)},
      {"pile.esp", ""},
      {"pile.esp", std::string(testing::kPileGrammar).substr(0, 120)},
      {"pile.esp", std::string("\xff\xfe\x00\x01", 4)},
  };
  for (const auto& [name, text] : bad) {
    write_pile(folder_);
    write_text(folder_ / name, text);
    const ChildResult run = espalier({"run", "scene.toml", "--out", "made"});
    EXPECT_EQ(run.exit_code, 2) << name << " " << text.substr(0, 20) << run.out << run.err;
    EXPECT_THAT(run.err, HasSubstr(fs::path(name).filename().string()));
    EXPECT_THAT(leftovers(), IsEmpty());
  }
}

TEST_F(Cmd, FoldersThatCannotBeWrittenAreRefusedBeforeTheSearch) {
  write_text(folder_ / "photos/dear.png", "dear");
  for (const char* out : {"photos", "scene.toml", "scene.toml/x", "/proc/nowhere/x"}) {
    const ChildResult run = espalier({"run", "scene.toml", "--out", out});
    EXPECT_EQ(run.exit_code, 2) << out;
    EXPECT_THAT(run.out, Not(HasSubstr("step"))) << out;
    EXPECT_FALSE(run.err.empty());
  }
  EXPECT_THAT(leftovers(), ::testing::ElementsAre("photos"));
  EXPECT_EQ(read_text(folder_ / "photos/dear.png"), "dear");
}

TEST_F(Cmd, InterruptedItLeavesAWholeFolder) {
  ChildOptions options;
  options.interrupt_when = "\"event\":\"step\"";
  const ChildResult run = espalier({"run", "scene.toml", "--out", "made", "--time", "600", "--json"}, options);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto result = nlohmann::json::parse(read_text(folder_ / "made/result.json"));
  EXPECT_EQ(result["stopped_by"], "interrupt");
  const std::size_t others = result["alternatives"].size();  // three files each, and a sheet of all
  EXPECT_EQ(read_tree(folder_ / "made").size(), 13u + 3 * others + (others > 0 ? 1 : 0));
  EXPECT_THAT(leftovers(), ::testing::ElementsAre("made"));
  EXPECT_EQ(espalier({"reproduce", "made/best.glb"}).exit_code, 0);
}

// A limit on the size of files stands for a full disk: writes fail half-way, wherever the tests run.
TEST_F(Cmd, AFullDiskKeepsWhatFitsAndSaysWhere) {
  ASSERT_EQ(espalier({"run", "scene.toml", "--out", "made"}).exit_code, 0);
  const auto size = [&](const char* name) { return fs::file_size(folder_ / "made/" + name); };
  const auto limit = size("best.derivation.json") + 10;
  ASSERT_GT(size("best.png"), limit) << "the picture must not fit";
  fs::remove_all(folder_ / "made");
  ChildOptions options;
  options.most_file_bytes = limit;
  const ChildResult run = espalier({"run", "scene.toml", "--out", "made"}, options);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("The results are incomplete; what could be written is kept in made.partial-"));
  EXPECT_FALSE(fs::exists(folder_ / "made"));
  ASSERT_EQ(leftovers().size(), 1u);
  const std::string kept = leftovers()[0];
  EXPECT_THAT(run.err, HasSubstr(kept));
  EXPECT_EQ(espalier({"score", "scene.toml", kept + "/best.derivation.json"}).exit_code, 0);
}

TEST_F(Cmd, ADiskThatTakesNothingLeavesNothing) {
  ChildOptions options;
  options.most_file_bytes = 16;
  const ChildResult run = espalier({"run", "scene.toml", "--out", "made"}, options);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(leftovers(), IsEmpty());
}

TEST_F(Cmd, ScoreInspectReproduceAndExportWorkOnARun) {
  ASSERT_EQ(espalier({"run", "scene.toml", "--out", "made"}).exit_code, 0);
  const auto result = nlohmann::json::parse(read_text(folder_ / "made/result.json"));
  const ChildResult score = espalier({"score", "scene.toml", "made/best.derivation.json", "--json"});
  EXPECT_EQ(score.exit_code, 0) << score.err;
  EXPECT_EQ(nlohmann::json::parse(score.out)["score"], result["score"]);
  const ChildResult text = espalier({"score", "made/run.toml", "made/best.derivation.json"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("score "), HasSubstr("inside tower.obj"), HasSubstr("genes")));

  const ChildResult inspect = espalier({"inspect", "made/alternatives/01.png", "--json"});
  EXPECT_EQ(inspect.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(inspect.out)["index"], 1);
  EXPECT_THAT(espalier({"inspect", "made/best.obj"}).out, AllOf(HasSubstr("seed 3, 6 steps"), HasSubstr("grammar =")));
  EXPECT_EQ(espalier({"inspect", "pile.esp"}).exit_code, 2);

  const ChildResult same = espalier({"reproduce", "made/best.png"});
  EXPECT_EQ(same.exit_code, 0) << same.out;
  EXPECT_THAT(same.out, HasSubstr("\nidentical\n"));
  const ChildResult exported = espalier({"export", "made/best.derivation.json", "-o", "ship.stl"});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_GT(fs::file_size(folder_ / "ship.stl"), 84u);
  EXPECT_EQ(espalier({"export", "made/best.derivation.json", "-o", "ship.doc"}).exit_code, 2);
  EXPECT_EQ(espalier({"export", "pile.esp", "-o", "ship.stl"}).exit_code, 2);
  write_text(folder_ / "made/inputs/pile.esp", "grammar pile 1\n");
  EXPECT_EQ(espalier({"reproduce", "made/best.png"}).exit_code, 1);
}

TEST_F(Cmd, ExportWritesLevelsOfDetail) {
  const std::string grammar = ESPALIER_SOURCE_DIR "/grammars/arboretum.esp";
  const ChildResult grown =
      espalier({"sample", grammar, "-D", "most_spans=100", "-n", "1", "--only-genes", "--out", "s"});
  ASSERT_EQ(grown.exit_code, 0) << grown.err;
  const ChildResult all = espalier({"export", "s/01.derivation.json", "-o", "t.glb", "--joints", "smooth", "--lods"});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_THAT(all.out, AllOf(HasSubstr("level  triangles  of lod0"), HasSubstr("100.0 %"),
                             HasSubstr("wrote t-lod3.glb")));
  const ChildResult one =
      espalier({"export", "s/01.derivation.json", "-o", "one.glb", "--joints", "smooth", "--lod", "2"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto bytes = [&](const std::string& name) { return read_text((fs::path(folder_.path()) / name).string()); };
  EXPECT_EQ(bytes("one.glb"), bytes("t-lod2.glb"));
  EXPECT_GT(bytes("t-lod0.glb").size(), bytes("t-lod3.glb").size());
  // Made again as they were: the level stands in the provenance.
  for (const char* name : {"t-lod1.glb", "one.glb"}) {
    const ChildResult again = espalier({"reproduce", name});
    EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  }
  const auto picture = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line = {"render", "s/01.derivation.json", "-o", "p.png", "--size", "40x40"};
    line.insert(line.end(), more.begin(), more.end());
    return espalier(line);
  };
  ASSERT_EQ(picture({"--joints", "smooth", "--lod", "3"}).exit_code, 0);
  EXPECT_EQ(espalier({"reproduce", "p.png"}).exit_code, 0);
  EXPECT_EQ(picture({"--lod", "1", "--view", "bones"}).exit_code, 2);
  const std::vector<std::vector<std::string>> refusals = {
      {"--lod", "4"}, {"--joints", "welded"}, {"--lod", "1", "--lods"}};
  for (const std::vector<std::string>& wrong : refusals) {
    std::vector<std::string> line = {"export", "s/01.derivation.json", "-o", "wrong.glb"};
    line.insert(line.end(), wrong.begin(), wrong.end());
    const ChildResult refused = espalier(line);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr(wrong[0]));
  }
}

TEST_F(Cmd, SpeciesOfTheArboretumAreWhole) {
  const fs::path grammars = ESPALIER_SOURCE_DIR "/grammars";
  std::size_t species = 0;
  for (const auto& entry : fs::directory_iterator(grammars / "species")) {
    const ChildResult genes = espalier({"inspect", entry.path().string(), "--genes"});  // finds its grammar above
    EXPECT_EQ(genes.exit_code, 0) << genes.err << "run script/species";
    EXPECT_THAT(genes.out, HasSubstr("habit"));
    ++species;
  }
  EXPECT_GE(species, 10u);
}

TEST_F(Cmd, PreviewShowsAndTellsBeforeAnySearch) {
  const ChildResult preview = espalier({"preview", "scene.toml", "-o", "seen/p.png", "--seed", "7"});
  EXPECT_EQ(preview.exit_code, 0) << preview.err;
  EXPECT_THAT(preview.out, AllOf(HasSubstr("pile, seed 7"), HasSubstr("tower.obj: "), HasSubstr("sample 4: "),
                                 HasSubstr("wrote seen/p.png")));
  EXPECT_TRUE(read_text(folder_ / "seen/p.png").starts_with("\x89PNG"));
  EXPECT_THAT(espalier({"inspect", "seen/p.png"}).out, HasSubstr("preview"));
  const ChildResult json = espalier({"preview", "scene.toml", "--json", "--set", "volume.cells=500", "-D", "widest=2"});
  EXPECT_EQ(json.exit_code, 0) << json.err;
  const auto told = nlohmann::json::parse(json.out);
  EXPECT_EQ(told["picture"], "out/scene-preview.png");
  EXPECT_LT(told["targets"][0]["cells"][1], 30);
  EXPECT_TRUE(fs::exists(folder_ / "out/scene-preview.png"));
  const ChildResult away = espalier({"preview", "scene.toml", "--set", "volume.mesh.0.position=[0,0,50]"});
  EXPECT_EQ(away.exit_code, 0);
  EXPECT_THAT(away.err, HasSubstr("warning: tower.obj: all of it lies where none"));
}

TEST_F(Cmd, PreviewRefusesBadInput) {
  EXPECT_EQ(espalier({"preview", "none.toml", "-o", "p.png"}).exit_code, 2);
  EXPECT_EQ(espalier({"preview", "scene.toml", "-o", "p.jpg"}).exit_code, 2);
  EXPECT_EQ(espalier({"preview", "scene.toml", "-o", "scene.toml/p.png"}).exit_code, 2);
  EXPECT_EQ(espalier({"preview", "scene.toml", "-o", "p.png", "--set", "volume.cell=1"}).exit_code, 2);
  EXPECT_THAT(leftovers(), IsEmpty());
}

TEST_F(Cmd, SampleWritesItsFolder) {
  const ChildResult sample = espalier({"sample", "pile.esp", "-n", "2", "--seed", "5", "--grow", "3", "--out", "s"});
  EXPECT_EQ(sample.exit_code, 0) << sample.err;
  EXPECT_THAT(sample.out, HasSubstr("wrote s/samples.png"));
  EXPECT_TRUE(fs::exists(folder_ / "s/02.glb"));
  EXPECT_EQ(espalier({"reproduce", "s/02.glb"}).exit_code, 0);
  EXPECT_EQ(espalier({"sample", "none.esp", "--out", "t"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "t"));
}

TEST_F(Cmd, SampleGoesOnFromAnother) {
  const char* ancestor = "s/02.derivation.json";
  EXPECT_EQ(espalier({"sample", "pile.esp", "-n", "2", "--grow", "1", "--only-genes", "--out", "s"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "s/02.glb"));
  const ChildResult grown =
      espalier({"sample", "pile.esp", "--from", ancestor, "-n", "1", "--grow", "2", "--only-genes", "--out", "t"});
  EXPECT_EQ(grown.exit_code, 0) << grown.err;
  EXPECT_THAT(grown.out, AllOf(HasSubstr("wrote 1 sample to t"), Not(HasSubstr("samples.png"))));
  EXPECT_EQ(espalier({"reproduce", "t/01.derivation.json"}).exit_code, 0);
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{
           {"--from", ancestor}, {"--from", ancestor, "--genes", "9"}, {"--from", "none", "--grow", "1"},
           {"--from", ancestor, "--grow", "1", "-D", "widest=2"}}) {
    std::vector<std::string> arguments = {"sample", "pile.esp", "--out", "u"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const ChildResult result = espalier(arguments);
    EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(bad);
    EXPECT_FALSE(result.err.empty());
  }
  EXPECT_FALSE(fs::exists(folder_ / "u"));
}

}  // namespace
}  // namespace espalier
