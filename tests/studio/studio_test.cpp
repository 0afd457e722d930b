// The studio over a real socket, as a page sees it.
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/error.h"
#include "io/file.h"
#include "model/primitives.h"
#include "studio/model_message.h"
#include "studio/page.h"
#include "studio/project_file.h"
#include "studio/scene_json.h"
#include "studio/studio_fixture.h"
#include "studio/zip_reader.h"

namespace espalier::studio {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kCurves = R"({"curve": [{"points": [[0,0,0],[0,1,0],[1,1,1],[2,2,1]]}]})";

/// A page that looks at models.
class ModelPage final : public Page {
 public:
  using Page::Page;

  /// A model made for the document as it is now, or later.
  bool wait_for_model() {
    const std::int64_t revision = seen["document"]["revision"];
    return wait_for("shown", [&](const json& shown) { return shown["revision"] >= revision; });
  }
  json edit(const std::string& grammar) { return {{"label", "edit"}, {"grammar", grammar}}; }
  json scene_with(const std::string& key, const std::string& value) {
    json scene = seen["document"]["scene"];
    scene[key] = json::parse(value);
    return scene;
  }

  std::string model, meshes, cloud;  // binary messages
  int models = 0;

 private:
  void took(const std::string& letters, const std::string& bytes) override {
    if (letters == "ESPM") model = bytes, ++models;
    if (letters == "ESPG") meshes = bytes;
    if (letters == "ESPC") cloud = bytes;
  }
};

class StudioTest : public StudioFixture {
 protected:
  ModelPage page() { return ModelPage(server_->port(), token_); }
};

TEST_F(StudioTest, ANewProjectIsCheckedAndShown) {
  ModelPage page = this->page();
  EXPECT_GT(page.seen["projects"]["samples"].size(), 20u);
  EXPECT_EQ(page.ask("edit", page.edit("x")), "no project is open");
  EXPECT_EQ(page.ask("create_project", {{"name", "Plant"}}), "");
  EXPECT_EQ(page.seen["document"]["project"]["name"], "Plant");
  ASSERT_TRUE(page.wait_for("checked"));
  EXPECT_EQ(page.seen["checked"]["problems"].size(), 0u) << page.seen["checked"];
  EXPECT_EQ(page.seen["checked"]["attributes"][0]["name"], "forks");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_GT(page.seen["shown"]["genes"], 2);
  EXPECT_FALSE(page.seen["shown"].contains("score"));
  // The binary message says the same.
  EXPECT_EQ(page.meshes.substr(0, 4), "ESPG");
  EXPECT_EQ(word_at(page.model, 8), page.seen["shown"]["model"]);
  EXPECT_EQ(word_at(page.model, 24), page.seen["shown"]["genes"]);
  EXPECT_EQ(word_at(page.model, 28), word_at(page.meshes, 8));
  EXPECT_EQ(page.model.size(), 32 + 64 * word_at(page.model, 12) + 32 * word_at(page.model, 16) +
                                   48 * word_at(page.model, 20) + 8 * word_at(page.model, 24));
}

TEST_F(StudioTest, EverySampleIsReadAndShowsAModel) {
  ModelPage page = this->page();
  const json samples = page.seen["projects"]["samples"];
  for (const json& sample : samples) {
    const std::string name = sample["name"];
    EXPECT_FALSE(sample["words"].get<std::string>().empty()) << name;
    ASSERT_TRUE(sample.contains("picture")) << name << ": script/samples makes one";
    EXPECT_THAT(http("GET /" + sample["picture"].get<std::string>()).head, HasSubstr("image/webp")) << name;
    EXPECT_EQ(page.ask("create_project", {{"name", name}, {"sample", name}}), "") << name;
    ASSERT_TRUE(page.wait_for("checked", [&](const json& checked) { return checked["revision"] == 1; })) << name;
    EXPECT_FALSE(page.seen["checked"].contains("scene_problem")) << name << page.seen["checked"]["scene_problem"];
    page.seen.erase("shown");
    ASSERT_TRUE(page.wait_for("shown")) << name;
    page.ask("stop_search");
    page.seen.erase("checked");
    EXPECT_EQ(page.ask("delete_project", {{"project", page.seen["document"]["project"]["id"]}}), "");
  }
}

// Projects count their mesh tables each for itself, so equal numbers say nothing.
TEST_F(StudioTest, AnotherProjectBringsItsOwnMeshes) {
  ModelPage page = this->page();
  ASSERT_EQ(page.ask("create_project", {{"name", "a"}, {"sample", "guided-tree"}}), "");
  ASSERT_TRUE(page.wait_for_model());
  const json rules = page.seen["shown"]["rules"];
  const std::string tree = page.meshes;
  ASSERT_EQ(page.ask("create_project", {{"name", "b"}, {"sample", "spaceship"}}), "");
  ASSERT_TRUE(page.wait_for("shown", [&](const json& shown) { return shown["rules"] != rules; }));
  EXPECT_TRUE(page.meshes != tree);
  EXPECT_EQ(word_at(page.model, 28), word_at(page.meshes, 8));
}

TEST_F(StudioTest, ErrorsOfTheGrammarHavePlacesAsThePageCounts) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  const std::string text = "grammar a 1\n# \xf0\x9f\x8c\xb2 \xc3\xa4\nstart A\nrule A { spawn B }\n";
  EXPECT_EQ(page.ask("edit", page.edit(text)), "");
  ASSERT_TRUE(page.wait_for("checked", [](const json& checked) { return checked["revision"] == 2; }));
  const json problem = page.seen["checked"]["problems"][0];
  EXPECT_EQ(problem["severity"], "error");
  // The tree is two code units and four bytes, the letter one and two.
  const std::int64_t bytes = static_cast<std::int64_t>(text.find("B }"));
  EXPECT_EQ(problem["at"]["from"], bytes - 3);
  // Sliders stay as they were, and so does the model.
  EXPECT_EQ(page.seen["checked"]["attributes"].size(), 1u);
  EXPECT_EQ(page.ask("undo"), "");
  ASSERT_TRUE(page.wait_for("checked", [](const json& checked) { return checked["revision"] == 3; }));
  EXPECT_EQ(page.seen["checked"]["problems"].size(), 0u);
}

TEST_F(StudioTest, ACurveIsFollowedAndTheSearchStopsAndGoesOn) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  EXPECT_EQ(page.ask("edit", {{"label", "Draw"}, {"scene", page.scene_with("curves", kCurves)}, {"search", true}}), "");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_TRUE(page.seen["shown"].contains("score"));
  EXPECT_FALSE(page.seen["shown"]["terms"].empty());
  EXPECT_EQ(page.ask("start_search", {{"seconds", 1000}, {"from", "shown"}}), "");
  ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return state["running"] && state["steps"] > 10; }));
  EXPECT_EQ(page.ask("stop_search"), "");
  ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return !state["running"]; }));
  const json stopped = page.seen["search_state"];
  EXPECT_TRUE(stopped["onward"]);
  EXPECT_LE(stopped["rises"].size(), 200u);
  EXPECT_EQ(page.ask("start_search", {{"seconds", 0.05}, {"onward", true}}), "");
  const auto further = [&](const json& state) { return !state["running"] && state["steps"] > stopped["steps"]; };
  ASSERT_TRUE(page.wait_for("search_state", further));
  EXPECT_GE(page.seen["search_state"]["best"], stopped["best"]);
}

TEST_F(StudioTest, UndoBringsBackTheModelOfBeforeASearchAndRedoWhatItFound) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  page.ask("edit", {{"label", "Draw"}, {"scene", page.scene_with("curves", kCurves)}, {"search", true}});
  const auto over = [](const json& state) { return state["steps"] > 0 && !state["running"]; };
  ASSERT_TRUE(page.wait_for("search_state", over));
  const auto model = [&] {
    page.ask("keep_favourite");
    const std::string path = "GET /projects/" + page.seen["document"]["project"]["id"].dump() + "/export/espalier";
    return parse_project_file(http(path).body).favourites.back().derivation;
  };
  const std::string best = model();
  page.ask("edit", {{"label", "Seed"}, {"scene", page.scene_with("seed", "77")}});
  page.seen.erase("search_state");
  EXPECT_EQ(page.ask("start_search", {{"seconds", 0.05}}), "");
  EXPECT_EQ(page.seen["document"]["undo"], "Search");
  ASSERT_TRUE(page.wait_for("search_state", over));
  const std::string other = model();
  ASSERT_NE(other, best);
  // Also while another search goes on, which stops.
  EXPECT_EQ(page.ask("start_search", {{"seconds", 1000}}), "");
  EXPECT_EQ(page.ask("undo"), "");
  ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return !state["running"]; }));
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(model(), other);
  EXPECT_EQ(page.ask("undo"), "");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(model(), best);
  EXPECT_EQ(page.ask("redo"), "");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(model(), other);
}

TEST_F(StudioTest, AGeneIsAskedForByItsPathToo) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  const json model = page.seen["shown"]["model"];
  EXPECT_EQ(page.ask("ask_gene", {{"path", "Plant/Stem"}, {"model", model}}), "");
  EXPECT_EQ(page.seen["gene"]["gene"], 1);
  EXPECT_EQ(page.seen["gene"]["path"], "Plant/Stem");
  EXPECT_THAT(page.ask("ask_gene", {{"path", "Plant/Leaf"}, {"model", model}}), HasSubstr("Leaf"));
  EXPECT_THAT(page.ask("ask_gene", {{"path", ""}, {"model", model}}), testing::Not(""));
  EXPECT_THAT(page.ask("ask_gene", {{"model", model}}), HasSubstr("either gene or path"));
  EXPECT_THAT(page.ask("ask_gene", {{"path", "Plant"}, {"gene", 0}, {"model", model}}), HasSubstr("either gene or path"));
}

TEST_F(StudioTest, ASearchThatAnEditBeginsTakesTheTimeOfTheScene) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  const auto stands = [](const json& state) { return !state["running"]; };
  const auto runs = [](const json& state) { return state["running"] && state["steps"] > 0; };
  page.ask("edit", {{"label", "Draw"}, {"scene", page.scene_with("curves", kCurves)}});
  page.ask("start_search", {{"seconds", 1000}, {"from", "nothing"}});
  ASSERT_TRUE(page.wait_for("search_state", runs));
  // Nothing but its time ends this one.
  page.seen.erase("search_state");
  page.ask("edit", {{"label", "Time"}, {"scene", page.scene_with("budget", R"({"seconds": 0.2})")}, {"search", true}});
  ASSERT_TRUE(page.wait_for("search_state", runs));
  ASSERT_TRUE(page.wait_for("search_state", stands));
  EXPECT_GE(page.seen["search_state"]["seconds"], 0.2);
  // What is asked for goes before what the scene says.
  page.ask("start_search", {{"seconds", 1000}, {"from", "shown"}});
  ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return state["running"] && state["seconds"] > 0.5; }));
}

TEST_F(StudioTest, AttributesSayTheirLabelsAndSteps) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.ask("edit", page.edit("grammar a 1\n\n# How many there are.\nattr n in 1..9 by 2 = 3 \"Tree/Forks\"\n"
                             "attr bend in 0deg..90deg by 5deg = 30deg\nstart A\nrule A { turn x bend  move y n  emit box }\n"));
  const std::int64_t revision = page.seen["document"]["revision"];
  ASSERT_TRUE(page.wait_for("checked", [&](const json& checked) { return checked["revision"] == revision; }));
  ASSERT_EQ(page.seen["checked"]["attributes"].size(), 2u) << page.seen["checked"];
  const json n = page.seen["checked"]["attributes"][0], bend = page.seen["checked"]["attributes"][1];
  EXPECT_EQ(n["label"], "Tree/Forks");
  EXPECT_EQ(n["comment"], "How many there are.");
  EXPECT_EQ(n["step"], 2);
  EXPECT_EQ(bend["step"], 5);
  EXPECT_EQ(bend["unit"], "deg");
  EXPECT_FALSE(bend.contains("label"));
  EXPECT_FALSE(bend.contains("comment"));
}

TEST_F(StudioTest, FilesAreCalledAsTheProjectCallsThem) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  // The rule that nobody asks for is a warning of the log.
  page.ask("edit", page.edit("grammar a 1\nstart A\nrule A { emit box }\nrule B { emit box }\n"));
  ASSERT_TRUE(page.wait_for("log"));
  EXPECT_THAT(page.seen["log"]["text"], HasSubstr("grammar.esp:4"));
  EXPECT_THAT(page.seen["log"]["text"], testing::Not(HasSubstr("/")));
  page.ask("edit", page.edit("grammar a 1\nmesh m = \"none.obj\"\nstart A\nrule A { emit m }\n"));
  const auto faulty = [](const json& checked) { return checked.contains("scene_problem"); };
  ASSERT_TRUE(page.wait_for("checked", faulty));
  EXPECT_THAT(page.seen["checked"]["scene_problem"], HasSubstr("none.obj"));
  EXPECT_THAT(page.seen["checked"]["scene_problem"], testing::Not(HasSubstr("/")));
}

TEST_F(StudioTest, UndoAndRedoTakeBackScenesDrawsAndLocks) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  const json number = page.seen["shown"]["model"];
  ASSERT_EQ(page.ask("ask_gene", {{"gene", 1}, {"model", number}}), "");
  const json gene = page.seen["gene"];
  EXPECT_EQ(gene["rule"], "Stem");
  EXPECT_EQ(gene["path"], "Plant/Stem");
  ASSERT_EQ(gene["draws"].size(), 2u);
  EXPECT_EQ(gene["draws"][1]["low"], "0deg");
  EXPECT_EQ(gene["draws"][1]["high"], "40deg");
  for (const double quantile : {0.25, 0.5}) {
    EXPECT_EQ(page.ask("set_draw", {{"gene", 1}, {"model", number}, {"index", 1}, {"quantile", quantile}, {"gesture", "g"}}), "");
  }
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(page.seen["document"]["undo"], "Set a draw of Stem");
  const auto draw = [&] {
    page.ask("ask_gene", {{"gene", 1}, {"model", page.seen["shown"]["model"]}});
    return page.seen["gene"]["draws"][1]["value"];
  };
  EXPECT_EQ(draw(), "20deg");
  EXPECT_EQ(page.ask("set_lock", {{"gene", 1}, {"model", page.seen["shown"]["model"]}, {"locked", true}}), "");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(page.seen["shown"]["locked"], json::parse("[1]"));
  EXPECT_EQ(page.ask("undo"), "");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(page.seen["shown"]["locked"].size(), 0u);
  EXPECT_EQ(draw(), "20deg");
  EXPECT_EQ(page.ask("undo"), "");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(draw(), gene["draws"][1]["value"]);
  EXPECT_EQ(page.ask("undo"), "there is nothing to undo");
  EXPECT_EQ(page.ask("redo"), "");
  ASSERT_TRUE(page.wait_for_model());
  EXPECT_EQ(draw(), "20deg");
}

TEST_F(StudioTest, ALockedGeneStaysWhileTheRestIsSearched) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  page.ask("edit", {{"label", "Draw"}, {"scene", page.scene_with("curves", kCurves)}, {"search", true}});
  ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return state["steps"] > 0 && !state["running"]; }));
  const auto draws = [&] {
    page.ask("ask_gene", {{"gene", 1}, {"model", page.seen["shown"]["model"]}});
    return page.seen["gene"]["draws"];
  };
  const json before = draws();
  ASSERT_EQ(page.ask("set_draw", {{"gene", 1}, {"model", page.seen["shown"]["model"]}, {"index", 0}, {"quantile", 0.77}}), "");
  ASSERT_TRUE(page.wait_for_model());
  const json set = draws();
  EXPECT_NE(before, set);
  ASSERT_EQ(page.ask("set_lock", {{"gene", 1}, {"model", page.seen["shown"]["model"]}, {"locked", true}}), "");
  ASSERT_TRUE(page.wait_for_model());
  page.seen.erase("search_state");
  page.ask("start_search", {{"seconds", 0.3}, {"from", "shown"}});
  ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return state["steps"] > 0 && !state["running"]; }));
  EXPECT_EQ(draws(), set);
}

TEST_F(StudioTest, TwoTabsSeeTheSame) {
  ModelPage one = page();
  one.ask("create_project", {{"name", "a"}});
  one.wait_for_model();
  ModelPage two = page();
  ASSERT_EQ(two.ask("open_project", {{"project", one.seen["document"]["project"]["id"]}}), "");
  ASSERT_TRUE(two.wait_for("shown"));
  EXPECT_EQ(two.seen["shown"], one.seen["shown"]);
  EXPECT_EQ(two.model, one.model);
  const std::string grammar = two.seen["document"]["grammar"].get<std::string>() + "# more\n";
  one.ask("edit", one.edit(grammar));
  ASSERT_TRUE(two.wait_for("document", [&](const json& document) { return document["grammar"] == grammar; }));
  two.ask("undo");
  ASSERT_TRUE(one.wait_for("document", [&](const json& document) { return document["revision"] == 3; }));
  EXPECT_NE(one.seen["document"]["grammar"], grammar);
  two.client().hang_up();
  EXPECT_EQ(one.ask("redo"), "");
}

TEST_F(StudioTest, HostileGrammarsStallNothing) {
  ModelPage hostile = page();
  hostile.ask("create_project", {{"name", "hostile"}});
  hostile.wait_for_model();
  const std::vector<std::string> texts = {
      // A million parts in every gene, as often as it goes.
      "grammar a 1\nstart A\nrule A { for i in 1..100 { detail D } maybe 0.9 spawn B }\n"
      "rule B { for i in 1..100 { detail D } maybe 0.99 spawn A }\n"
      "detail D { for i in 1..100 { for k in 1..100 { emit box } } }\n",
      "grammar a 1\nstart A\nrule A { spawn A spawn A }\n",
      "grammar a 1\nstart A\nrule A { " + std::string(100'000, '{') + " }\n",
      "grammar a 1\nmesh m = mesh(\"../../../../etc/passwd\")\nstart A\nrule A { emit m }\n",
      "grammar a 1\nimport \"../../../../etc/passwd\"\nstart A\nrule A { emit box }\n",
      std::string(900'000, 'a'),
  };
  for (const std::string& text : texts) EXPECT_EQ(hostile.ask("edit", hostile.edit(text)), "");
  json scene = hostile.scene_with("curves", kCurves);
  scene["search"] = {{"engine", "ga"}};
  hostile.ask("edit", {{"label", "a"}, {"grammar", texts[0]}, {"scene", scene}, {"search", true}});
  // Meanwhile another project works, and this one listens.
  ModelPage other = page();
  EXPECT_EQ(other.ask("create_project", {{"name", "other"}}), "");
  EXPECT_TRUE(other.wait_for_model());
  EXPECT_EQ(hostile.ask("stop_search"), "");
  EXPECT_EQ(hostile.ask("edit", hostile.edit("grammar a 1\nstart A\nrule A { emit box }\n")), "");
  ASSERT_TRUE(hostile.wait_for_model());
  EXPECT_EQ(hostile.seen["shown"]["parts"], 1);
}

TEST_F(StudioTest, BadRequestsFailAndChangeNothing) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  const json before = page.seen["document"];
  EXPECT_THAT(page.ask("fly"), HasSubstr("no such kind"));
  EXPECT_THAT(page.ask("open_project", {{"project", 999}}), HasSubstr("no project 999"));
  EXPECT_THAT(page.ask("create_project", {{"name", "b"}, {"sample", "../x"}}), HasSubstr("no sample"));
  EXPECT_THAT(page.ask("ask_gene", {{"gene", 1}, {"model", 12345}}), HasSubstr("not shown any more"));
  EXPECT_THAT(page.ask("ask_gene", {{"gene", -1}, {"model", page.seen["shown"]["model"]}}), HasSubstr("has no gene -1"));
  EXPECT_THAT(page.ask("set_draw", {{"gene", 1}, {"model", page.seen["shown"]["model"]}, {"index", 99}, {"quantile", 0}}),
              HasSubstr("no draw 99"));
  EXPECT_THAT(page.ask("remove_file", {{"path", "a.obj"}}), HasSubstr("no file a.obj"));
  EXPECT_THAT(page.ask("show_favourite", {{"favourite", 4}}), HasSubstr("no such favourite"));
  EXPECT_EQ(page.seen["document"], before);
}

TEST_F(StudioTest, TheScenesReaderJudgesTheScene) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  const auto problem_of = [&](const std::string& key, const std::string& value) {
    page.ask("edit", {{"label", "a"}, {"scene", page.scene_with(key, value)}});
    const std::int64_t revision = page.seen["document"]["revision"];
    page.wait_for("checked", [&](const json& checked) { return checked["revision"] == revision; });
    const std::string problem = page.seen["checked"].value("scene_problem", "");
    page.ask("undo");
    return problem;
  };
  EXPECT_EQ(problem_of("seed", "2"), "");
  EXPECT_THAT(problem_of("seed", "-2"), testing::StartsWith("seed must be"));
  EXPECT_THAT(problem_of("speed", "1"), HasSubstr("speed"));
  EXPECT_THAT(problem_of("curves", R"({"curve": [{"points": [1, 2]}]})"), HasSubstr("curves.curve.0.points"));
  EXPECT_THAT(problem_of("volume", R"({"mesh": [{"file": "../../etc/passwd"}]})"), HasSubstr("must be a file of the project"));
}

TEST_F(StudioTest, FilesComeInAndAreFilled) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  const std::string base = "/projects/" + page.seen["document"]["project"]["id"].dump() + "/";
  const std::string box = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  EXPECT_EQ(http("POST " + base + "files/my%20box.obj", box).status, 200);
  ASSERT_TRUE(page.wait_for("document", [](const json& document) { return document["files"].size() == 1; }));
  EXPECT_EQ(page.seen["document"]["files"][0],
            json::parse(R"({"path": "my box.obj", "bytes": )" + std::to_string(box.size()) + R"(, "triangles": 4, "size": [1,2,3]})"));
  EXPECT_EQ(http("GET " + base + "files/my%20box.obj").body, box);
  const Answer preview = http("GET " + base + "previews/my%20box.obj");
  EXPECT_THAT(preview.head, HasSubstr("Content-Type: image/png"));
  EXPECT_GT(preview.body.size(), 1000u);
  EXPECT_EQ(http("GET " + base + "previews/my%20box.obj").body, preview.body);
  EXPECT_EQ(http("GET " + base + "previews/other.obj").status, 404);
  EXPECT_NE(http("POST " + base + "files/..%2f..%2fx.obj", box).status, 200);
  EXPECT_EQ(http("POST " + base + "files/grammar.esp", box).status, 400);
  EXPECT_EQ(http("POST " + base + "files/x.exe", box).status, 400);
  EXPECT_THAT(http("POST " + base + "files/bad.obj", "no mesh").body, HasSubstr("bad.obj"));
  for (const char* file : {"my box.obj", "shapes/sphere.obj"}) {
    const json scene = page.scene_with("volume", R"({"cells": 8000, "mesh": [{"file": ")" + std::string(file) + R"("}]})");
    page.ask("edit", {{"label", "Fill"}, {"scene", scene}, {"search", true}});
    ASSERT_TRUE(page.wait_for_model());
    EXPECT_TRUE(page.seen["shown"].contains("score")) << file;
  }
  page.ask("stop_search");
  page.ask("remove_file", {{"path", "my box.obj"}});
  EXPECT_EQ(page.seen["document"]["files"].size(), 0u);
  page.ask("undo");
  EXPECT_EQ(http("GET " + base + "files/my%20box.obj").body, box);
}

TEST_F(StudioTest, MeshesOfAnyFormatAreSentAsPagesDrawThem) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  const std::string base = "/projects/" + page.seen["document"]["project"]["id"].dump() + "/";
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                          "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const std::string glb = http("GET " + base + "export/glb").body, stl = http("GET " + base + "export/stl").body;
  const auto word = [](const std::string& message, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, message.data() + at, sizeof(value));
    return value;
  };
  for (const auto& [name, bytes] : {std::pair("m.obj", obj), std::pair("m.ply", ply), std::pair("m.glb", glb), std::pair("m.stl", stl)}) {
    ASSERT_EQ(http("POST " + base + "files/" + name, bytes).status, 200) << name;
    ASSERT_TRUE(page.wait_for("document", [](const json& document) { return document["files"].size() == 1; }));
    const json file = page.seen["document"]["files"][0];
    const Answer answer = http("GET " + base + "meshes/" + name);
    ASSERT_EQ(answer.status, 200) << name;
    const std::string& form = answer.body;
    ASSERT_EQ(form.substr(0, 4), "ESPG") << name;
    const std::uint32_t vertices = word(form, 16), triangles = word(form, 20);
    EXPECT_EQ(word(form, 8), file["triangles"].get<std::uint32_t>()) << name;
    EXPECT_EQ(word(form, 12), 1u);
    EXPECT_GT(triangles, 0u);
    EXPECT_LE(triangles, word(form, 8));
    EXPECT_EQ(form.size(), 28 + 24 * std::size_t{vertices} + 12 * std::size_t{triangles}) << name;
    Bounds box;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      Vec3 p;
      std::memcpy(&p, form.data() + 28 + 12 * v, sizeof(p));
      box.add(p);
    }
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(box.size()[axis], file["size"][axis].get<float>(), 1e-4f) << name;
    page.ask("remove_file", {{"path", name}});
    EXPECT_EQ(page.seen["document"]["files"].size(), 0u);
  }
  EXPECT_EQ(http("GET " + base + "meshes/m.obj").status, 404);
  EXPECT_EQ(http("POST " + base + "files/part.esp", "rule A { }").status, 200);
  EXPECT_EQ(http("GET " + base + "meshes/part.esp").status, 404);
}

TEST_F(StudioTest, MeshesWithTooManyTrianglesAreSentAsTheirBoxes) {
  Mesh mesh = make_primitive(MeshKind::sphere, 1, 0);
  for (Vec3& p : mesh.positions) p = 2.0f * p + Vec3(5, 0, 0);
  const std::string whole = mesh_message(7, mesh, mesh.triangles.size()), box = mesh_message(7, mesh, mesh.triangles.size() - 1);
  EXPECT_EQ(whole[20], static_cast<char>(mesh.triangles.size() & 0xff));
  EXPECT_EQ(box[8], 7);
  EXPECT_EQ(box[20], 12);
  Vec3 corner;
  std::memcpy(&corner, box.data() + 28, sizeof(corner));
  EXPECT_NEAR(std::abs(corner.x - 5), bounds(mesh).size().x / 2, 1e-5f);
}

TEST_F(StudioTest, ExportsAreRunAndReproduced) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "My tree!"}});
  page.wait_for_model();
  page.ask("edit", {{"label", "Draw"}, {"scene", page.scene_with("curves", kCurves)}, {"search", false}});
  page.seen.erase("search_state");
  page.ask("start_search", {{"seconds", 0.1}, {"from", "nothing"}});
  ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return state["steps"] > 0 && !state["running"]; }));
  const std::string base = "/projects/" + page.seen["document"]["project"]["id"].dump() + "/export/";
  EXPECT_EQ(http("GET " + base + "glb").body.substr(0, 4), "glTF");
  const Answer png = http("GET " + base + "png");
  ASSERT_EQ(png.status, 200) << png.head;
  EXPECT_EQ(png.body.substr(1, 3), "PNG");
  EXPECT_EQ(http("GET " + base + "ply").body.substr(0, 3), "ply");
  EXPECT_GT(http("GET " + base + "stl").body.size(), 84u);
  EXPECT_EQ(http("GET " + base + "obj").body.substr(0, 4), "PK\x03\x04");
  EXPECT_EQ(http("GET " + base + "exe").status, 400);
  const std::map<std::string, std::string> levels = read_zip(http("GET " + base + "lods").body);
  ASSERT_EQ(levels.size(), 5u);
  for (int level = 1; level < 4; ++level) {
    const auto file = [&](int of) { return levels.at("my-tree/my-tree-lod" + std::to_string(of) + ".glb"); };
    EXPECT_LT(file(level).size(), file(level - 1).size()) << level;
  }
  EXPECT_THAT(levels.at("my-tree/triangles.csv"), testing::MatchesRegex("file,triangles\n(my-tree-lod[0-3].glb,[0-9]+\n)+"));
  const Answer zip = http("GET " + base + "zip");
  EXPECT_THAT(zip.head, HasSubstr("filename=\"my-tree.zip\""));
  write_file(folder_.file("scene.zip"), zip.body);
  write_file(folder_.file("unzip.cmake"),
             "file(ARCHIVE_EXTRACT INPUT " + folder_.file("scene.zip") + " DESTINATION " + folder_.file("out") + ")\n");
  const auto run = [&](const std::string& command) {
    return std::system(("cd '" + folder_.file("") + "' && " + command + " > log.txt 2>&1").c_str());
  };
  ASSERT_EQ(run("cmake -P unzip.cmake"), 0);
  const std::string program = std::string("'") + ESPALIER_PROGRAM + "' ";
  EXPECT_EQ(run(program + "run out/my-tree/scene.toml --generations 3 --set 'output.picture=[64,48]' --out ran"), 0) << read_file(folder_.file("log.txt"));
  EXPECT_EQ(run(program + "reproduce out/my-tree/best.derivation.json"), 0) << read_file(folder_.file("log.txt"));

  // What went out comes in again, with the model.
  const Answer imported = http("POST /projects/import", zip.body);
  ASSERT_EQ(imported.status, 200) << imported.body;
  const json genes = page.seen["shown"]["genes"], scene = page.seen["document"]["scene"], grammar = page.seen["document"]["grammar"];
  page.seen.erase("shown");
  EXPECT_EQ(page.ask("open_project", {{"project", std::stoi(imported.body)}}), "");
  ASSERT_TRUE(page.wait_for("shown"));
  EXPECT_EQ(page.seen["document"]["project"]["name"], "my-tree");
  EXPECT_EQ(page.seen["document"]["grammar"], grammar);
  EXPECT_EQ(page.seen["document"]["scene"]["curves"]["curve"][0]["points"], scene["curves"]["curve"][0]["points"]);
  EXPECT_EQ(page.seen["shown"]["genes"], genes);
  ASSERT_TRUE(page.wait_for("checked", [](const json& checked) { return checked["revision"] == 1; }));
  EXPECT_FALSE(page.seen["checked"].contains("scene_problem")) << page.seen["checked"];
  EXPECT_EQ(http("POST /projects/import", zip.body.substr(0, zip.body.size() / 2)).status, 400);
}

/// Of the picture of the newest favourite.
std::string favourite_path(const json& document) {
  return "GET /projects/" + document["project"]["id"].dump() + "/favourites/" + document["favourites"].back()["id"].dump();
}

TEST_F(StudioTest, FavouritesHavePictures) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}, {"sample", "spaceship"}});
  ASSERT_TRUE(page.wait_for("shown"));
  page.ask("stop_search");
  const json model = page.seen["shown"]["model"];
  EXPECT_EQ(page.ask("keep_favourite"), "");
  EXPECT_EQ(page.seen["document"]["favourites"][0]["picture"], false);
  EXPECT_EQ(http(favourite_path(page.seen["document"])).status, 404);
  const std::string picture = std::string("RIFF\4\0\0\0WEBP", 12) + "bytes";
  EXPECT_EQ(page.ask("keep_favourite", {{"model", model}, {"picture", encode_base64(picture)}}), "");
  EXPECT_EQ(page.seen["document"]["favourites"][1]["picture"], true);
  const Answer got = http(favourite_path(page.seen["document"]));
  EXPECT_EQ(got.body, picture);
  EXPECT_THAT(got.head, HasSubstr("Content-Type: image/webp"));
  EXPECT_THAT(page.ask("keep_favourite", {{"model", 9999}}), HasSubstr("not shown any more"));
  EXPECT_THAT(page.ask("keep_favourite", {{"picture", "????"}}), HasSubstr("base64"));
  EXPECT_THAT(page.ask("keep_favourite", {{"picture", encode_base64("<svg onload=..>")}}), HasSubstr("must be a PNG"));
  EXPECT_THAT(page.ask("keep_favourite", {{"picture", encode_base64(picture + std::string(32u << 10, 'x'))}}),
              HasSubstr("at most"));
  EXPECT_EQ(page.seen["document"]["favourites"].size(), 2u);

  const json dropped = page.seen["document"]["favourites"][1];
  EXPECT_EQ(page.ask("drop_favourite", {{"favourite", dropped["id"]}}), "");
  EXPECT_EQ(page.seen["document"]["favourites"].size(), 1u);
  EXPECT_EQ(page.ask("restore_favourite", {{"favourite", dropped["id"]}}), "");
  EXPECT_EQ(page.seen["document"]["favourites"].size(), 2u);
  EXPECT_EQ(page.seen["document"]["favourites"][1]["score"], dropped["score"]);
  EXPECT_EQ(http(favourite_path(page.seen["document"])).body, picture);
  EXPECT_EQ(page.ask("show_favourite", {{"favourite", page.seen["document"]["favourites"][1]["id"]}}), "");
  EXPECT_THAT(page.ask("restore_favourite", {{"favourite", dropped["id"]}}), HasSubstr("no such favourite"));
}

TEST_F(StudioTest, PagesThatLeaveBeforeTheyCameInAreGone) {
  constexpr int kProjects = 14;  // more than may be open
  std::vector<int> projects;
  {
    ModelPage page = this->page();
    for (int i = 0; i < kProjects; ++i) {
      ASSERT_EQ(page.ask("create_project", {{"name", std::to_string(i)}, {"sample", "spaceship"}}), "");
      projects.push_back(page.seen["document"]["project"]["id"].get<int>());
      page.ask("stop_search");
    }
  }
  for (const int project : projects) {
    ModelPage busy = this->page();
    ASSERT_EQ(busy.ask("open_project", {{"project", project}}), "");
    // The session's thread has enough to do, and who comes in has to wait.
    for (int i = 0; i < 40; ++i) busy.send("edit", {{"label", "Set"}, {"scene", {{"seed", i}}}, {"search", false}});
    ModelPage hasty = this->page();
    hasty.send("open_project", {{"project", project}});
  }
  ModelPage page = this->page();
  for (const int project : projects) {
    // The last pages may be leaving still.
    std::string answer;
    for (int tries = 0; tries < 100; ++tries) {
      answer = page.ask("open_project", {{"project", project}});
      if (answer.empty()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ASSERT_EQ(answer, "") << project;
  }
}

TEST_F(StudioTest, ProjectsGoOutAndInAsOneFile) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}, {"sample", "spaceship"}});
  ASSERT_TRUE(page.wait_for("shown"));
  page.ask("stop_search");
  const std::string picture = "\x89PNG\r\n\x1a\n and so on";
  EXPECT_EQ(page.ask("keep_favourite", {{"model", page.seen["shown"]["model"]}, {"picture", encode_base64(picture)}}), "");
  const std::string whole = http("GET /projects/" + page.seen["document"]["project"]["id"].dump() + "/export/espalier").body;
  const Answer taken = http("POST /projects/import", whole);
  ASSERT_EQ(taken.status, 200) << taken.body;
  const json before = page.seen["document"];
  EXPECT_EQ(page.ask("open_project", {{"project", std::stoi(taken.body)}}), "");
  for (const char* key : {"grammar", "scene", "files"}) EXPECT_EQ(page.seen["document"][key], before[key]) << key;
  EXPECT_EQ(page.seen["document"]["favourites"].size(), 1u);
  EXPECT_EQ(http(favourite_path(page.seen["document"])).body, picture);
  EXPECT_EQ(page.seen["document"]["project"]["name"], "a 2");

  json damaged = json::parse(whole);
  const auto refused = [&](const json& file) { return http("POST /projects/import", file.dump()).status == 400; };
  EXPECT_TRUE(refused("no project"));
  EXPECT_TRUE(refused(json::object()));
  const std::map<std::string, json> changes = {
      {"espalier_project", 2}, {"grammar", 1}, {"scene", "x"}, {"files", 3}, {"shown", nullptr}};
  for (const auto& [key, value] : changes) {
    json bad = damaged;
    bad[key] = value;
    EXPECT_TRUE(refused(bad)) << key;
  }
  for (const char* path : {"../a.obj", "/etc/x.obj", "a.exe"}) {
    json bad = damaged;
    bad["files"][0]["path"] = path;
    EXPECT_TRUE(refused(bad)) << path;
  }
  damaged["files"][0]["bytes"] = "????";
  EXPECT_TRUE(refused(damaged));
  EXPECT_EQ(http("POST /projects/import", std::string(50'000, '[')).status, 400);
}

TEST_F(StudioTest, AfterARestartAllIsThereTheModelToo) {
  json document, shown;
  {
    ModelPage page = this->page();
    page.ask("create_project", {{"name", "a"}});
    page.wait_for_model();
    page.ask("edit", {{"label", "Draw"}, {"scene", page.scene_with("curves", kCurves)}, {"search", true}});
    ASSERT_TRUE(page.wait_for("search_state", [](const json& state) { return state["steps"] > 0 && !state["running"]; }));
    document = page.seen["document"], shown = page.seen["shown"];
  }
  start();
  ModelPage page = this->page();
  EXPECT_EQ(page.ask("open_project", {{"project", document["project"]["id"]}}), "");
  EXPECT_EQ(page.seen["document"], document);
  ASSERT_TRUE(page.wait_for("shown"));
  for (const char* key : {"genes", "parts", "score"}) EXPECT_EQ(page.seen["shown"][key], shown[key]) << key;
}

TEST_F(StudioTest, ACloudTellsWhereARuleLands) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.wait_for_model();
  page.ask("ask_reach", {{"rule", "Stem"}});
  while (page.cloud.empty()) ASSERT_TRUE(page.ask("stop_search").empty());
  EXPECT_EQ(word_at(page.cloud, 8), 4u);
  EXPECT_EQ(page.cloud.substr(16, 4), "Stem");
  EXPECT_GT(word_at(page.cloud, 12), 200u);
  EXPECT_EQ(page.cloud.size(), 20 + 16 * word_at(page.cloud, 12));
}

TEST_F(StudioTest, FormatIsAStep) {
  ModelPage page = this->page();
  page.ask("create_project", {{"name", "a"}});
  page.ask("edit", page.edit("grammar a 1\nstart A\nrule   A{emit box}\n"));
  EXPECT_EQ(page.ask("format"), "");
  EXPECT_EQ(page.seen["document"]["grammar"], "grammar a 1\nstart A\nrule A { emit box }\n");
  EXPECT_EQ(page.seen["document"]["undo"], "Format");
  page.ask("edit", page.edit("grammar {"));
  EXPECT_THAT(page.ask("format"), HasSubstr("cannot be read"));
}

TEST(ProjectFile, Base64) {
  for (const char* text : {"", "a", "ab", "abc", "abcd"}) EXPECT_EQ(decode_base64(encode_base64(text)), text);
  EXPECT_EQ(encode_base64("Many hands"), "TWFueSBoYW5kcw==");
  for (const char* bad : {"a", "ab=c", "=abc", "ab?=", "ab\n=", "====", "A==="}) EXPECT_THROW(decode_base64(bad), Error) << bad;
}

TEST(SceneJson, AnglesAreDegreesAndUnknownAttributesAreLeftOut) {
  const std::map<std::string, Kind> kinds = {{"facing", Kind::angle}, {"tall", Kind::number}};
  const auto values = attributes_of(R"({"attributes": {"facing": 30, "tall": 2.5, "gone": 1}})", kinds);
  EXPECT_EQ(values, (std::map<std::string, std::string>{{"facing", "30deg"}, {"tall", "2.5"}}));
}

}  // namespace
}  // namespace espalier::studio
