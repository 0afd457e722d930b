// The breeding room over a real socket, as a page sees it.
#include <set>

#include <gmock/gmock.h>

#include "run/temporary_folder.h"
#include "studio/breeding_page.h"
#include "studio/studio.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class BreedingTest : public testing::Test {
 protected:
  BreedingTest() { start(); }
  void start() {
    server_.reset();
    studio_.reset();
    studio_ = std::make_unique<Studio>(folder_.file("studio.sqlite"));
    server_ = std::make_unique<WebServer>(WebServerSettings{.token = token_, .page_folder = folder_.file("page")}, *studio_);
  }
  std::unique_ptr<BreedingPage> page() { return std::make_unique<BreedingPage>(server_->port(), token_); }
  /// A page with a project of that sample.
  std::unique_ptr<BreedingPage> project(const std::string& sample) {
    auto page = this->page();
    EXPECT_EQ(page->ask("create_project", {{"name", sample}, {"sample", sample}}), "");
    return page;
  }
  std::string begin(BreedingPage& page, json settings = json::object(), const std::string& from = "nothing", int seed = 7) {
    const std::string answer = page.ask("start_breeding", {{"settings", settings}, {"from", from}, {"seed", seed}});
    page.wait_for_models();
    return answer;
  }
  Answer http(const std::string& request, const std::string& body = "") {
    return ask(server_->port(), request, "X-Espalier-Token: " + token_ + "\r\n", body);
  }

  TemporaryFolder folder_;
  std::string token_ = make_token();
  std::unique_ptr<Studio> studio_;
  std::unique_ptr<WebServer> server_;
};

TEST_F(BreedingTest, AFirstScreenIsShownRatedAndBred) {
  const auto page_of = project("gentree-natural");
  BreedingPage& page = *page_of;
  ASSERT_TRUE(page.wait_for("breedings"));
  EXPECT_EQ(page.seen["breedings"]["sessions"].size(), 0u);
  ASSERT_EQ(begin(page), "");
  ASSERT_EQ(page.breeding()["individuals"].size(), 12u);
  EXPECT_EQ(page.seen["breedings"]["sessions"].size(), 1u);
  EXPECT_EQ(page.seen["breedings"]["open"], page.session()["id"]);
  std::set<std::string> different;
  for (const std::int64_t id : page.ids()) {
    EXPECT_EQ(page.individual(id)["origin"], "sampled");
    EXPECT_TRUE(page.bred[id]["viable"]) << page.bred[id];
    EXPECT_GT(page.bred[id]["triangles"], 0);
    const std::string& model = page.models[id];
    ASSERT_EQ(model.substr(0, 4), "ESPI");
    EXPECT_EQ(word_in(model, 8), page.session()["id"]);
    EXPECT_EQ(word_in(model, 16), page.individual(id)["version"]);
    const std::string inner = model.substr(24);
    EXPECT_EQ(inner.substr(0, 4), "ESPM");
    EXPECT_EQ(word_in(inner, 28), word_in(page.meshes, 8));
    EXPECT_EQ(inner.size(), 32 + 64 * word_in(inner, 12) + 32 * word_in(inner, 16) + 48 * word_in(inner, 20) +
                                8 * word_in(inner, 24));
    different.insert(inner);
  }
  EXPECT_EQ(different.size(), 12u);

  const std::vector<std::int64_t> first = page.ids();
  EXPECT_EQ(page.ask("rate", {{"ratings", {{{"individual", first[2]}, {"rating", 3}}, {{"individual", first[5]}, {"rating", -1}}}}}), "");
  EXPECT_EQ(page.individual(first[2])["rating"], 3);
  EXPECT_EQ(page.breeding()["undo"], "Rate some");
  EXPECT_EQ(page.ask("breed"), "");
  ASSERT_TRUE(page.wait_for_models());
  EXPECT_EQ(page.breeding()["generation"], 2);
  EXPECT_EQ(page.breeding()["generations"][1]["parent"], 1);
  const json kept = page.breeding()["individuals"][0];
  EXPECT_EQ(kept["origin"], "kept");
  EXPECT_EQ(kept["parents"], json::array({first[2]}));
  EXPECT_EQ(kept["rating"], 3);
  EXPECT_EQ(page.models[kept["id"]].substr(24 + 32), page.models[first[2]].substr(24 + 32));
}

json rating(std::int64_t individual, double rating) { return {{"ratings", {{{"individual", individual}, {"rating", rating}}}}}; }

json draw(std::int64_t individual, int index, double quantile) {
  return {{"individual", individual}, {"draws", {{{"gene", 0}, {"index", index}, {"quantile", quantile}}}}};
}

TEST_F(BreedingTest, EverythingIsUndoneAndDoneAgain) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page), "");
  const std::vector<std::int64_t> first = page.ids();
  EXPECT_EQ(page.ask("undo_breeding"), "there is nothing to undo");
  EXPECT_EQ(page.ask("rate", rating(first[0], 2)), "");
  EXPECT_EQ(page.ask("rate", {{"ratings", {{{"individual", first[0]}}}}}), "");
  EXPECT_FALSE(page.individual(first[0]).contains("rating"));
  EXPECT_EQ(page.ask("undo_breeding"), "");
  EXPECT_EQ(page.individual(first[0])["rating"], 2);

  // A slider is one step, however often it moves.
  const std::string before = page.models[first[1]];
  for (const double quantile : {0.1, 0.5, 0.9}) {
    json set = draw(first[1], 2, quantile);
    set["gesture"] = "taper";
    EXPECT_EQ(page.ask("set_genes", set), "");
  }
  ASSERT_TRUE(page.wait_for_models());
  EXPECT_TRUE(page.individual(first[1])["edited"]);
  EXPECT_NE(page.models[first[1]].substr(56), before.substr(56));
  const std::string after = page.models[first[1]];
  EXPECT_EQ(page.ask("undo_breeding"), "");
  ASSERT_TRUE(page.wait_for_models());
  EXPECT_FALSE(page.individual(first[1])["edited"]);
  EXPECT_EQ(page.models[first[1]].substr(56), before.substr(56));
  EXPECT_EQ(page.ask("redo_breeding"), "");
  ASSERT_TRUE(page.wait_for_models());
  EXPECT_EQ(page.models[first[1]].substr(56), after.substr(56));

  EXPECT_EQ(page.ask("compare", {{"better", first[2]}, {"worse", first[3]}}), "");
  EXPECT_EQ(page.individual(first[2])["rating"], 1);
  EXPECT_EQ(page.individual(first[3])["rating"], -1);
  EXPECT_EQ(page.ask("set_breeding", {{"settings", {{"strength", 0.9}, {"population", 9}}}}), "");
  EXPECT_EQ(page.breeding()["settings"]["strength"], 0.9);
  EXPECT_EQ(page.ask("lock_draws", {{"draws", {{{"path", "Tree"}, {"index", 3}}}}, {"locked", true}}), "");
  EXPECT_EQ(page.breeding()["locked"].size(), 1u);
  EXPECT_EQ(page.ask("breed"), "");
  EXPECT_EQ(page.breeding()["individuals"].size(), 9u);
  EXPECT_EQ(page.breeding()["undo"], "Bred");
  for (const char* what : {"breed", "lock", "settings", "compare"}) EXPECT_EQ(page.ask("undo_breeding"), "") << what;
  EXPECT_EQ(page.ids(), first);
  EXPECT_EQ(page.breeding()["locked"].size(), 0u);
  EXPECT_EQ(page.breeding()["settings"]["population"], 12);
  EXPECT_FALSE(page.individual(first[2]).contains("rating"));
  EXPECT_EQ(page.breeding()["generations"].size(), 2u) << "a generation that was bred is never lost";
  for (int i = 0; i < 4; ++i) EXPECT_EQ(page.ask("redo_breeding"), "");
  EXPECT_EQ(page.breeding()["generation"], 2);
  EXPECT_EQ(page.ask("redo_breeding"), "there is nothing to do again");
}

TEST_F(BreedingTest, LockedDrawsAndEditsByHandAreInherited) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page), "");
  const std::int64_t id = page.ids()[4];
  const json paste = {{"individual", id},
                      {"draws", {{{"gene", 0}, {"index", 1}, {"quantile", 0.25}}, {{"gene", 0}, {"index", 3}, {"quantile", 0.75}}}}};
  EXPECT_EQ(page.ask("set_genes", paste), "");
  EXPECT_EQ(page.ask("lock_draws", {{"draws", {{{"path", "Tree"}, {"index", 1}}, {{"path", "Tree"}, {"index", 3}}}}, {"locked", true}}), "");
  // Only one parent: all are its children, but for newcomers.
  EXPECT_EQ(page.ask("set_breeding", {{"settings", {{"newcomers", 0}, {"strength", 1}}}}), "");
  EXPECT_EQ(page.ask("rate", rating(id, 5)), "");
  EXPECT_EQ(page.ask("breed"), "");
  int heirs = 0;
  for (const std::int64_t child : page.ids()) {
    if (page.individual(child)["parents"][0] != id) continue;
    ASSERT_EQ(page.ask("ask_individual", {{"individual", child}}), "");
    const json& gene = page.seen["individual_genes"]["genes"][0];
    EXPECT_EQ(gene["path"], "Tree");
    EXPECT_EQ(gene["locked"], json::array({1, 3}));
    EXPECT_EQ(gene["draws"][1]["quantile"], 0.25);
    EXPECT_EQ(gene["draws"][3]["quantile"], 0.75);
    ++heirs;
  }
  EXPECT_GT(heirs, 0);
  EXPECT_EQ(page.seen["individual_genes"]["genes"][0]["draws"][3]["name"], "taper");
}

TEST_F(BreedingTest, TheFourModesAllowWhatTheySay) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  for (const auto& [mode, rates, edits] : {std::tuple{"rate_and_edit", true, true}, {"rate", true, false}, {"edit", false, true},
                                           {"neither", false, false}}) {
    ASSERT_EQ(begin(page, {{"mode", mode}, {"population", 9}}), "");
    const std::int64_t id = page.ids()[0];
    EXPECT_EQ(page.ask("rate", rating(id, 1)) == "", rates) << mode;
    EXPECT_EQ(page.ask("compare", {{"better", id}, {"worse", page.ids()[1]}}) == "", rates) << mode;
    EXPECT_EQ(page.ask("set_genes", draw(id, 0, 0.4)) == "", edits) << mode;
    EXPECT_EQ(page.ask("blend", {{"parents", page.ids()}, {"weights", {1}}, {"keep", true}}) == "", false);
    EXPECT_EQ(page.ask("blend", {{"parents", {id, page.ids()[1]}}, {"weights", {1, 1}}, {"keep", true}}) == "", edits) << mode;
    EXPECT_EQ(page.ask("breed"), "") << mode;
    EXPECT_EQ(page.breeding()["generation"], 2);
  }
  EXPECT_EQ(page.seen["breedings"]["sessions"].size(), 4u);
}

TEST_F(BreedingTest, GenTreeIsBredAsItWas) {
  const auto owned = project("gentree");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page, {{"method", "classic"}}), "");
  EXPECT_EQ(page.breeding()["individuals"].size(), 20u);
  EXPECT_EQ(page.breeding()["settings"]["classic"]["crossover"], 0.6);
  EXPECT_EQ(page.breeding()["settings"]["classic"]["mutation"], 0.001);
  EXPECT_EQ(page.ask("set_breeding", {{"settings", {{"method", "free"}}}}), "a session keeps its method: begin another one from its individuals");
  const std::vector<std::int64_t> first = page.ids();
  EXPECT_EQ(page.ask("rate", {{"ratings", {{{"individual", first[3]}, {"rating", 4}}, {{"individual", first[8]}, {"rating", 2}}}}}), "");
  EXPECT_EQ(page.ask("set_breeding", {{"settings", {{"classic", {{"gray", false}, {"selection", "rank"}}}}}}), "");
  EXPECT_EQ(page.ask("breed"), "");
  EXPECT_EQ(page.breeding()["individuals"].size(), 20u);
  EXPECT_FALSE(page.breeding()["settings"]["classic"]["gray"]);
  bool elite = false;
  for (const json& one : page.breeding()["individuals"]) elite = elite || (one["parents"] == json::array({first[3]}) && one.value("rating", 0.0) == 4);
  EXPECT_TRUE(elite);
  const auto other = project("city");
  EXPECT_THAT(begin(*other, {{"method", "classic"}}), HasSubstr("draws of the start rule"));
}

TEST_F(BreedingTest, HistoryBranchesAndReplaysToTheBit) {
  const auto owned = project("spaceship");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page, {{"population", 9}}), "");
  const std::string project = std::to_string(page.seen["document"]["project"]["id"].get<int>());
  const std::vector<std::int64_t> first = page.ids();
  EXPECT_EQ(page.ask("rate", rating(first[1], 1)), "");
  EXPECT_EQ(page.ask("breed"), "");
  EXPECT_EQ(page.ask("rate", rating(page.ids()[5], 3)), "");
  EXPECT_EQ(page.ask("breed"), "");
  EXPECT_EQ(page.ask("go_to_generation", {{"generation", 1}}), "");
  EXPECT_EQ(page.ids(), first);
  // What becomes of an ancestor later does not change what was bred from it.
  EXPECT_EQ(page.ask("rate", rating(first[1], -7)), "");
  EXPECT_EQ(page.ask("rate", rating(first[7], 7)), "");
  EXPECT_EQ(page.ask("blend", {{"parents", {first[0], first[7]}}, {"weights", {1, 3}}, {"keep", true}}), "");
  EXPECT_EQ(page.breeding()["individuals"].size(), 10u);
  EXPECT_EQ(page.breeding()["individuals"][9]["origin"], "blended");
  EXPECT_EQ(page.ask("breed"), "");
  EXPECT_EQ(page.breeding()["generation"], 4);
  EXPECT_EQ(page.breeding()["generations"][3]["parent"], 1);
  EXPECT_EQ(page.breeding()["generations"][2]["depth"], 2);
  EXPECT_EQ(page.breeding()["generations"][3]["depth"], 1);
  const std::int64_t liked = page.ids()[2];
  EXPECT_EQ(page.ask("more_like_this", {{"individual", liked}}), "");
  EXPECT_EQ(page.breeding()["individuals"][0]["origin"], "kept");
  EXPECT_EQ(page.breeding()["individuals"][1]["origin"], "sibling");
  EXPECT_EQ(page.breeding()["individuals"][1]["parents"], json::array({liked}));
  EXPECT_EQ(page.ask("ask_lineage"), "");
  std::set<std::int64_t> known;
  for (const json& one : page.seen["lineage"]["individuals"]) {
    for (const json& parent : one["parents"]) EXPECT_EQ(known.count(parent), 1u);
    known.insert(one["id"].get<std::int64_t>());
  }
  EXPECT_EQ(known.size(), 46u);
  // An ancestor can be looked at.
  page.models.erase(first[3]);
  EXPECT_EQ(page.ask("ask_model", {{"individual", first[3]}}), "");
  EXPECT_EQ(page.models.count(first[3]), 1u);

  const std::string session = std::to_string(page.session()["id"].get<int>());
  EXPECT_EQ(http("GET /projects/" + project + "/breeding/" + session + "/replay").body, "5 generations with 45 individuals came out the same\n");
  // The same in another project, and as part of a project.
  const Answer file = http("GET /projects/" + project + "/breeding/" + session + "/export");
  ASSERT_EQ(file.status, 200) << file.body;
  const auto elsewhere = this->project("plant");
  const std::string other = std::to_string(elsewhere->seen["document"]["project"]["id"].get<int>());
  const Answer taken = http("POST /projects/" + other + "/breeding/import", file.body);
  ASSERT_EQ(taken.status, 200) << taken.body;
  ASSERT_TRUE(elsewhere->wait_for("breedings", [](const json& list) { return list["sessions"].size() == 1; }));
  EXPECT_EQ(http("GET /projects/" + other + "/breeding/" + std::to_string(std::stoi(taken.body)) + "/replay").body,
            "5 generations with 45 individuals came out the same\n");
  EXPECT_EQ(elsewhere->ask("open_breeding", {{"session", std::stoi(taken.body)}}), "");
  EXPECT_THAT(elsewhere->breeding()["problem"].get<std::string>(), HasSubstr("another text of the grammar"));
  EXPECT_THAT(elsewhere->ask("breed"), HasSubstr("another text of the grammar"));
  const Answer whole = http("POST /projects/import", http("GET /projects/" + project + "/export/espalier").body);
  ASSERT_EQ(whole.status, 200) << whole.body;
  const auto copy = this->page();
  EXPECT_EQ(copy->ask("open_project", {{"project", std::stoi(whole.body)}}), "");
  ASSERT_TRUE(copy->wait_for("breedings"));
  ASSERT_EQ(copy->seen["breedings"]["sessions"].size(), 1u);
  EXPECT_EQ(copy->ask("open_breeding", {{"session", copy->seen["breedings"]["sessions"][0]["id"]}}), "");
  EXPECT_EQ(copy->ids(), page.ids());
  ASSERT_TRUE(copy->wait_for_models());
  ASSERT_TRUE(page.wait_for_models());
  for (const std::int64_t id : page.ids()) EXPECT_EQ(copy->models[id].substr(56), page.models[id].substr(56));
}

TEST_F(BreedingTest, ATasteModelChoosesAndSaysWhy) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page, {{"taste", true}}), "");
  ASSERT_TRUE(page.wait_for("breeding", [](const json& now) { return now.contains("diversity"); }));
  EXPECT_GT(page.breeding()["diversity"], 0.5);
  EXPECT_FALSE(page.breeding()["individuals"][0].contains("taste")) << "nothing was said yet";
  for (int round = 0; round < 3; ++round) {
    json ratings;
    for (const std::int64_t id : page.ids()) {
      const double height = page.bred[id]["height"];
      ratings.push_back({{"individual", id}, {"rating", height}});  // taller is better
    }
    EXPECT_EQ(page.ask("rate", {{"ratings", ratings}}), "");
    EXPECT_EQ(page.ask("compare", {{"better", page.ids()[0]}, {"worse", page.ids()[1]}}), "");
    EXPECT_EQ(page.ask("breed"), "");
    ASSERT_TRUE(page.wait_for_models());
  }
  ASSERT_TRUE(page.wait_for("breeding", [](const json& now) { return now["individuals"].back().contains("taste"); }));
  std::set<std::string> roles;
  for (const json& one : page.breeding()["individuals"]) {
    EXPECT_GE(one["taste"]["sd"], 0);
    if (one.contains("role")) roles.insert(one["role"]);
  }
  EXPECT_THAT(roles, testing::IsSupersetOf({"best", "different", "uncertain"}));
  EXPECT_THAT(page.breeding()["notes"][0].get<std::string>(), HasSubstr("chosen from"));
  ASSERT_TRUE(page.breeding().contains("taste_why"));
  EXPECT_THAT(page.breeding()["taste_why"][0].get<std::string>(), HasSubstr("like"));
  const std::string project = std::to_string(page.seen["document"]["project"]["id"].get<int>());
  EXPECT_EQ(http("GET /projects/" + project + "/breeding/1/replay").body, "4 generations with 48 individuals came out the same\n");
}

TEST_F(BreedingTest, ADamagedFileIsRefused) {
  const auto owned = project("gentree-natural");
  ASSERT_EQ(begin(*owned, {{"population", 9}}), "");
  const std::string path = "/projects/" + std::to_string(owned->seen["document"]["project"]["id"].get<int>()) + "/breeding/";
  const json good = json::parse(http("GET " + path + "1/export").body);
  const auto refused = [&](const char* pointer, const json& value) {
    json bad = good;
    bad[json::json_pointer(pointer)] = value;
    const Answer answer = http("POST " + path + "import", bad.dump());
    EXPECT_EQ(answer.status, 400) << pointer << ": " << answer.body;
    return answer.body;
  };
  EXPECT_THAT(refused("/espalier_breeding", 99), HasSubstr("version"));
  EXPECT_THAT(refused("/generations/0/number", 2), HasSubstr("generation"));
  EXPECT_THAT(refused("/generations/0/state", 7), HasSubstr("state"));
  EXPECT_THAT(refused("/generations/0/recipe", "{}"), HasSubstr("recipe"));
  EXPECT_THAT(refused("/individuals/3/id", 1), HasSubstr("individual"));
  EXPECT_THAT(refused("/individuals/3/parents", {77}), HasSubstr("parent"));
  EXPECT_THAT(refused("/individuals/3/derivation", "x"), HasSubstr("derivation"));
  EXPECT_THAT(refused("/individuals/3/origin", "stolen"), HasSubstr("stolen"));
  EXPECT_THAT(refused("/derivations", {{"00", "{}"}}), HasSubstr("derivation"));
  EXPECT_THAT(refused("/settings", R"({"kind":"set_breeding","settings":{"population":1e9}})"), HasSubstr("population"));
  EXPECT_THAT(refused("/states/0/files", {{{"path", "../x.obj"}, {"bytes", ""}}}), HasSubstr("elsewhere"));
  EXPECT_EQ(http("POST " + path + "import", "{").status, 400);
  EXPECT_EQ(http("POST " + path + "import", "[]").status, 400);
  EXPECT_EQ(http("GET " + path + "99/export").status, 400);
  EXPECT_EQ(http("GET " + path + "1/model/99/glb").status, 400);
  EXPECT_EQ(http("GET " + path + "1/model/3/doc").status, 400);
  EXPECT_EQ(http("GET " + path + "1/nothing").status, 404);
  EXPECT_EQ(http("GET " + path + "1/model/3/glb").body.substr(0, 4), "glTF");
}

TEST_F(BreedingTest, ASpeciesPackIsManyFilesWithinALimit) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page, {{"population", 9}}), "");
  const std::string path = "/projects/" + std::to_string(page.seen["document"]["project"]["id"].get<int>()) + "/breeding/1/species/";
  const std::int64_t id = page.ids()[0];
  const int triangles = page.bred[id]["triangles"].get<int>() * 2;
  const auto pack = [&](const std::string& rest) { return http("GET " + path + std::to_string(id) + "/" + rest); };
  const Answer zip = pack("5/" + std::to_string(triangles));
  ASSERT_EQ(zip.status, 200) << zip.body.substr(0, 200);
  EXPECT_EQ(zip.body.substr(0, 2), "PK");
  for (const char* name : {"/001.glb", "/005.glb", "/species.json"}) EXPECT_THAT(zip.body, HasSubstr(name));
  EXPECT_EQ(zip.body.find("/006.glb"), std::string::npos);
  EXPECT_EQ(pack("5/" + std::to_string(triangles)).body, zip.body);
  EXPECT_EQ(pack("5/1").status, 400);
  EXPECT_EQ(pack("0/1000").status, 400);
  EXPECT_EQ(pack("100000/1000").status, 400);
  EXPECT_EQ(pack("5/x").status, 400);
}

TEST_F(BreedingTest, ManyTabsSeeTheSameSession) {
  const auto one = project("gentree-natural");
  const auto two = this->page();
  EXPECT_EQ(two->ask("open_project", {{"project", one->seen["document"]["project"]["id"]}}), "");
  ASSERT_EQ(begin(*one), "");
  ASSERT_TRUE(two->wait_for("breedings", [](const json& list) { return list.contains("open"); }));
  EXPECT_EQ(two->seen.count("breeding"), 0u) << "it is not in the room";
  EXPECT_EQ(two->ask("open_breeding", {{"session", one->session()["id"]}}), "");
  ASSERT_TRUE(two->wait_for_models());
  EXPECT_EQ(two->ids(), one->ids());
  for (const std::int64_t id : one->ids()) EXPECT_EQ(two->models[id], one->models[id]);
  EXPECT_EQ(two->ask("rate", rating(two->ids()[3], 2)), "");
  EXPECT_TRUE(one->wait_for("breeding", [&](const json& now) { return now["individuals"][3].value("rating", 0) == 2; }));
  EXPECT_EQ(one->ask("breed"), "");
  EXPECT_TRUE(two->wait_for("breeding", [&](const json& now) { return now["generation"] == 2; }));
  EXPECT_TRUE(two->wait_for_models());
  // A blend is for the page that moves it.
  two->models.clear();
  EXPECT_EQ(one->ask("blend", {{"parents", {one->ids()[0], one->ids()[1]}}, {"weights", {1, 2}}}), "");
  EXPECT_EQ(one->models.count(0), 1u);
  EXPECT_EQ(one->bred[0]["individual"], 0);
  EXPECT_EQ(two->ask("leave_breeding"), "");
  EXPECT_EQ(two->models.count(0), 0u);
  EXPECT_EQ(one->ask("rename_breeding", {{"session", one->session()["id"]}, {"name", "Oaks"}}), "");
  EXPECT_TRUE(two->wait_for("breedings", [](const json& list) { return list["sessions"][0]["name"] == "Oaks"; }));
  // The last one out closes the session; it is there again when somebody comes.
  const std::vector<std::int64_t> before = one->ids();
  EXPECT_EQ(one->ask("leave_breeding"), "");
  EXPECT_TRUE(two->wait_for("breedings", [](const json& list) { return !list.contains("open"); }));
  EXPECT_EQ(two->ask("rate", rating(1, 1)), "no breeding session is open");
  EXPECT_EQ(two->ask("open_breeding", {{"session", 1}}), "");
  EXPECT_EQ(two->ids(), before);
  EXPECT_EQ(two->ask("delete_breeding", {{"session", 1}}), "");
  EXPECT_EQ(two->seen["breedings"]["sessions"].size(), 0u);
  EXPECT_EQ(two->ask("breed"), "no breeding session is open");
}

TEST_F(BreedingTest, AFavouriteIsKeptAndShownAndBredFrom) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  EXPECT_EQ(page.ask("start_breeding", {{"settings", json::object()}, {"from", "favourites"}}), "the project has no favourites");
  ASSERT_EQ(begin(page), "");
  const std::int64_t id = page.ids()[6];
  EXPECT_EQ(page.ask("keep_individual", {{"individual", id}}), "");
  ASSERT_EQ(page.seen["document"]["favourites"].size(), 1u);
  EXPECT_EQ(page.seen["document"]["favourites"][0]["genes"], page.bred[id]["genes"]);
  EXPECT_EQ(page.ask("show_individual", {{"individual", id}}), "");
  EXPECT_EQ(page.seen["document"]["undo"], "Show an individual");
  ASSERT_TRUE(page.wait_for("shown", [&](const json& shown) { return shown["parts"] == page.bred[id]["parts"]; }));
  const std::string model = page.models[id];
  ASSERT_EQ(begin(page, json::object(), "favourites"), "");
  EXPECT_EQ(page.models[page.ids()[0]].substr(56), model.substr(56)) << "a founder comes first, as it is";
  ASSERT_EQ(begin(page, json::object(), "shown"), "");
  EXPECT_EQ(page.models[page.ids()[0]].substr(56), model.substr(56));
}

TEST_F(BreedingTest, TheGrammarMayChangeMeanwhile) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page), "");
  const std::int64_t id = page.ids()[0];
  const double height = page.bred[id]["height"];
  const std::int64_t version = page.individual(id)["version"];
  json scene = page.seen["document"]["scene"];
  scene["attributes"]["height"] = 4;
  EXPECT_EQ(page.ask("edit", {{"label", "taller"}, {"scene", scene}}), "");
  ASSERT_TRUE(page.wait_for("breeding", [&](const json& now) { return now["individuals"][0]["version"] != version; }));
  ASSERT_TRUE(page.wait_for_models());
  EXPECT_GT(page.bred[id]["height"], 1.5 * height);
  // A limit of the scene: what breaks it says so, and what is bred keeps it.
  scene["limits"]["height"] = {{"max", 12}};
  EXPECT_EQ(page.ask("edit", {{"label", "limit"}, {"scene", scene}}), "");
  const std::string before = page.seen["document"]["grammar"];
  EXPECT_EQ(page.ask("breed"), "");
  ASSERT_TRUE(page.wait_for_models());
  for (const std::int64_t child : page.ids()) {
    const bool kept = page.individual(child)["origin"] == "kept";
    EXPECT_TRUE(kept || page.bred[child]["height"] <= 12.001) << page.bred[child];
  }
  EXPECT_EQ(page.ask("edit", {{"label", "broken"}, {"grammar", "grammar x 1\nstart"}}), "");
  ASSERT_TRUE(page.wait_for("breeding", [](const json& now) { return now.contains("problem"); }));
  EXPECT_THAT(page.breeding()["problem"].get<std::string>(), HasSubstr("the grammar has errors"));
  EXPECT_EQ(page.ask("rate", rating(page.ids()[0], 1)), "");
  EXPECT_EQ(page.ask("edit", {{"label", "another"}, {"grammar", "grammar x 1\nstart A\nrule A { r ~ uniform(0, 1)  size (1 + r) emit box }\n"}}), "");
  ASSERT_TRUE(page.wait_for("breeding", [](const json& now) { return now["individuals"][0].contains("missing"); }));
  EXPECT_THAT(page.breeding()["problem"].get<std::string>(), HasSubstr("another text of the grammar"));
  EXPECT_THAT(page.ask("breed"), HasSubstr("another text of the grammar"));
  EXPECT_THAT(page.ask("ask_individual", {{"individual", id}}), HasSubstr("another text of the grammar"));
  EXPECT_EQ(page.ask("edit", {{"label", "back"}, {"grammar", before}}), "");
  ASSERT_TRUE(page.wait_for("breeding", [](const json& now) { return !now.contains("problem"); }));
  EXPECT_EQ(page.ask("breed"), "");
  const std::string project = std::to_string(page.seen["document"]["project"]["id"].get<int>());
  EXPECT_EQ(http("GET /projects/" + project + "/breeding/1/replay").body, "3 generations with 36 individuals came out the same\n");
}

TEST_F(BreedingTest, BadRequestsAreRefusedAndChangeNothing) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  EXPECT_EQ(page.ask("breed"), "no breeding session is open");
  EXPECT_EQ(page.ask("open_breeding", {{"session", 12}}), "there is no breeding session 12");
  EXPECT_EQ(page.ask("delete_breeding", {{"session", -1}}), "there is no breeding session -1");
  ASSERT_EQ(begin(page), "");
  const json before = page.breeding();
  const std::int64_t id = page.ids()[0];
  EXPECT_THAT(page.ask("rate", rating(999, 1)), HasSubstr("999 is not one of the generation"));
  EXPECT_THAT(page.ask("rate", {{"ratings", {{{"individual", id}, {"rating", 1}}, {{"individual", 0}, {"rating", 1}}}}}), HasSubstr("not one"));
  EXPECT_THAT(page.ask("rate", {{"ratings", {{{"individual", id}, {"rating", nullptr}}}}}), HasSubstr("must be a number"));
  json many;
  for (int i = 0; i < 5000; ++i) many.push_back({{"individual", id}, {"rating", 1}});
  EXPECT_THAT(page.ask("rate", {{"ratings", many}}), HasSubstr("at most 200"));
  EXPECT_THAT(page.ask("compare", {{"better", id}, {"worse", id}}), HasSubstr("itself"));
  EXPECT_THAT(page.ask("set_genes", draw(id, 77, 0.5)), HasSubstr("no draw 77"));
  json bad = draw(id, 1, 0.5);
  bad["draws"][0]["gene"] = 4'000'000'000;
  EXPECT_THAT(page.ask("set_genes", bad), HasSubstr("no gene"));
  EXPECT_THAT(page.ask("set_genes", draw(id, 1, 1.5)), HasSubstr("must be 0 .. 1"));
  EXPECT_THAT(page.ask("set_genes", draw(12345, 1, 0.5)), HasSubstr("12345"));
  many.clear();
  for (int i = 0; i < 3000; ++i) many.push_back({{"gene", 0}, {"index", 0}, {"quantile", 0.5}});
  EXPECT_THAT(page.ask("set_genes", {{"individual", id}, {"draws", many}}), HasSubstr("at most 2000"));
  EXPECT_NE(page.ask("lock_draws", {{"draws", {{{"path", "Nowhere"}, {"index", 0}}}}, {"locked", true}}), "");
  EXPECT_NE(page.ask("lock_draws", {{"draws", {{{"path", "Tree"}, {"index", 99999}}}}, {"locked", true}}), "");
  EXPECT_THAT(page.ask("blend", {{"parents", {id}}, {"weights", {1}}}), HasSubstr("two or three"));
  EXPECT_THAT(page.ask("blend", {{"parents", {id, id}}, {"weights", {1}}}), HasSubstr("weight for each"));
  EXPECT_THAT(page.ask("blend", {{"parents", {id, id}}, {"weights", {0, 0}}}), HasSubstr("not all be 0"));
  EXPECT_THAT(page.ask("blend", {{"parents", {id, id}}, {"weights", {-1, 2}}}), HasSubstr("weights"));
  EXPECT_THAT(page.ask("blend", {{"parents", {id, 4711}}, {"weights", {1, 2}}}), HasSubstr("no individual 4711"));
  EXPECT_THAT(page.ask("go_to_generation", {{"generation", 2}}), HasSubstr("no generation 2"));
  EXPECT_THAT(page.ask("more_like_this", {{"individual", 0}}), HasSubstr("not one"));
  EXPECT_THAT(page.ask("keep_individual", {{"individual", 0}}), HasSubstr("no individual 0"));
  EXPECT_THAT(page.ask("show_individual", {{"individual", 77}}), HasSubstr("no individual 77"));
  EXPECT_THAT(page.ask("ask_model", {{"individual", 77}}), HasSubstr("no individual 77"));
  EXPECT_THAT(page.ask("rename_breeding", {{"session", 1}, {"name", "  "}}), HasSubstr("name"));
  EXPECT_THAT(page.ask("set_breeding", {{"settings", {{"population", 500}}}}), HasSubstr("9 .. 20"));
  EXPECT_THAT(page.ask("start_breeding", {{"settings", {{"population", 9}, {"max_triangles", 1}}}, {"from", "nothing"}}), HasSubstr("viable"));
  page.seen.erase("breeding");
  EXPECT_EQ(page.ask("open_breeding", {{"session", 1}}), "");
  json after = page.breeding();
  EXPECT_EQ(after["individuals"], before["individuals"]);
  EXPECT_EQ(after["revision"], before["revision"]);
  EXPECT_FALSE(after.contains("undo"));
}

}  // namespace
}  // namespace espalier::studio
