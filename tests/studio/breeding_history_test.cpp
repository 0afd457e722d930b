// What becomes of a breeding session in the long run: branches, replay, files, other texts of the grammar.
#include <set>

#include <gmock/gmock.h>

#include "studio/breeding_fixture.h"

namespace espalier::studio {
namespace {

using testing::HasSubstr;

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
  EXPECT_EQ(http("GET /projects/" + project + "/breeding/" + session + "/replay").body,
            "5 generations with 45 individuals came out the same\n");
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
  // And in a copy of the project.
  EXPECT_EQ(page.ask("duplicate_project", {{"project", std::stoi(project)}}), "");
  const std::string twin = std::to_string(page.seen["projects"]["projects"][0]["id"].get<int>());
  EXPECT_EQ(page.seen["projects"]["projects"][0]["name"], "spaceship copy");
  EXPECT_EQ(page.ask("delete_project", {{"project", std::stoi(other)}}), "");
  int sessions = 0;
  for (int number = 1; number < 8; ++number) {
    const Answer again = http("GET /projects/" + twin + "/breeding/" + std::to_string(number) + "/replay");
    sessions += again.status == 200 && again.body == "5 generations with 45 individuals came out the same\n";
  }
  EXPECT_EQ(sessions, 1);
  const auto copy = this->page();
  EXPECT_EQ(copy->ask("open_project", {{"project", std::stoi(whole.body)}}), "");
  ASSERT_TRUE(copy->wait_for("breedings"));
  ASSERT_EQ(copy->seen["breedings"]["sessions"].size(), 1u);
  EXPECT_EQ(copy->ask("open_breeding", {{"session", copy->seen["breedings"]["sessions"][0]["id"]}}), "");
  EXPECT_EQ(copy->ids(), page.ids());
  ASSERT_TRUE(copy->wait_for_models());
  ASSERT_TRUE(page.wait_for_models());
  for (const std::int64_t id : page.ids()) EXPECT_EQ(copy->models[id].substr(24), page.models[id].substr(24));
}

TEST_F(BreedingTest, AnyGrammarIsBredWithAnyTargets) {
  for (const char* sample :
       {"city-filling", "guided-bonsai", "guided-mondrian", "tree-sketch", "facade", "meadow", "snake"}) {
    const auto owned = project(sample);
    BreedingPage& page = *owned;
    ASSERT_EQ(begin(page, {{"population", 9}}), "") << sample;
    ASSERT_EQ(page.ask("breed"), "") << sample;
    ASSERT_TRUE(page.wait_for_models());
    ASSERT_EQ(page.ids().size(), 9u) << sample;
    const std::string scene = page.seen["document"]["scene"].dump();
    const bool targets = scene.find("curve") != std::string::npos || scene.find("mesh") != std::string::npos ||
                         scene.find("silhouette") != std::string::npos;
    for (const std::int64_t id : page.ids()) {
      EXPECT_TRUE(page.bred[id]["viable"]) << sample << page.bred[id];
      EXPECT_EQ(page.bred[id].contains("score"), targets) << sample;
    }
  }
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
  EXPECT_EQ(http("GET /projects/" + project + "/breeding/1/replay").body,
            "4 generations with 48 individuals came out the same\n");
}

TEST_F(BreedingTest, AFileOfManyStatesIsKeptOnce) {
  const auto owned = project("city-filling");
  BreedingPage& page = *owned;
  ASSERT_EQ(begin(page, {{"population", 9}}), "");
  for (const double weight : {0.5, 0.6}) {
    json scene = page.seen["document"]["scene"];
    scene["volume"]["mesh"][0]["fill"] = weight;
    ASSERT_EQ(page.ask("edit", {{"label", "Set weight"}, {"scene", scene}}), "");
    ASSERT_EQ(page.ask("breed"), "");
    EXPECT_FALSE(page.breeding().contains("problem")) << page.breeding()["problem"];
  }
  const std::string path =
      "/projects/" + std::to_string(page.seen["document"]["project"]["id"].get<int>()) + "/breeding/";
  const json file = json::parse(http("GET " + path + "1/export").body);
  EXPECT_EQ(file["states"].size(), 3u);
  std::set<std::string> hashes;
  for (const json& state : file["states"]) {
    EXPECT_FALSE(state["files"].empty());
    for (const json& one : state["files"]) hashes.insert(one["hash"].get<std::string>());
  }
  EXPECT_EQ(file["files"].size(), hashes.size());
  EXPECT_EQ(file["files"].size(), file["states"][0]["files"].size());
  EXPECT_EQ(http("POST " + path + "import", file.dump()).status, 200);
}

TEST_F(BreedingTest, AProjectIsImportedWhollyOrNotAtAll) {
  const auto owned = project("gentree-natural");
  ASSERT_EQ(begin(*owned, {{"population", 9}}), "");
  const std::string id = std::to_string(owned->seen["document"]["project"]["id"].get<int>());
  json file = json::parse(http("GET /projects/" + id + "/export/espalier").body);
  file["breedings"][0]["individuals"].back()["id"] = 10'001;
  const Answer answer = http("POST /projects/import", file.dump());
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.body, HasSubstr("individuals"));
  EXPECT_EQ(owned->ask("list_projects"), "");
  EXPECT_EQ(owned->seen["projects"]["projects"].size(), 1u);
}

TEST_F(BreedingTest, ADamagedFileIsRefused) {
  const auto owned = project("gentree-natural");
  ASSERT_EQ(begin(*owned, {{"population", 9}}), "");
  const std::string path =
      "/projects/" + std::to_string(owned->seen["document"]["project"]["id"].get<int>()) + "/breeding/";
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
  EXPECT_THAT(refused("/settings", R"({"kind":"set_breeding","settings":{"population":1e9}})"),
              HasSubstr("population"));
  EXPECT_THAT(refused("/states/0/files", {{{"path", "../x.obj"}, {"hash", ""}}}), HasSubstr("elsewhere"));
  EXPECT_THAT(refused("/states/0/files", {{{"path", "x.obj"}, {"hash", "00"}}}), HasSubstr("x.obj"));
  EXPECT_THAT(refused("/files", {{"00", "AAAA"}}), HasSubstr("file 00"));
  EXPECT_THAT(refused("/individuals/3/rating", 1e6), HasSubstr("rating"));
  EXPECT_THAT(refused("/comparisons", {{{"better", 77}, {"worse", 1}}}), HasSubstr("comparison 1"));
  const auto refused_recipe = [&](const char* key, const json& value) {
    json recipe = json::parse(good["generations"][0]["recipe"].get<std::string>());
    recipe[key] = value;
    return refused("/generations/0/recipe", recipe.dump());
  };
  EXPECT_THAT(refused_recipe("number", 2), HasSubstr("is of generation 2"));
  EXPECT_THAT(refused_recipe("number", 1 << 16), HasSubstr("number"));
  EXPECT_THAT(refused_recipe("first_id", 0), HasSubstr("first individual"));
  EXPECT_THAT(refused_recipe("kind", "bred"), HasSubstr("no parents"));
  EXPECT_THAT(refused_recipe("opinions", json::array({json::array({good["individuals"][0]["derivation"], 1e9})})), HasSubstr("rating"));
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
  const std::string path =
      "/projects/" + std::to_string(page.seen["document"]["project"]["id"].get<int>()) + "/breeding/1/species/";
  const std::int64_t id = page.ids()[0];
  const int triangles = page.bred[id]["triangles"].get<int>() * 2;
  const auto pack = [&](const std::string& rest) { return http("GET " + path + std::to_string(id) + "/" + rest); };
  const Answer zip = pack("5/" + std::to_string(triangles));
  ASSERT_EQ(zip.status, 200) << zip.body.substr(0, 200);
  EXPECT_EQ(zip.body.substr(0, 2), "PK");
  for (const char* name : {"/001.glb", "/005.glb", "/005.derivation.json", "/species.json", "/species.png",
                           "/inputs/grammar.esp", "/inputs/start/favourite.derivation.json"}) {
    EXPECT_NE(zip.body.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(zip.body.find("/006.glb"), std::string::npos);
  EXPECT_EQ(pack("5/" + std::to_string(triangles)).body, zip.body);
  EXPECT_EQ(pack("5/1").status, 400);
  EXPECT_EQ(pack("0/1000").status, 400);
  EXPECT_EQ(pack("100000/1000").status, 400);
  EXPECT_EQ(pack("5/x").status, 400);
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
  EXPECT_EQ(
      page.ask("edit", {{"label", "another"},
                        {"grammar", "grammar x 1\nstart A\nrule A { r ~ uniform(0, 1)  size (1 + r) emit box }\n"}}),
      "");
  ASSERT_TRUE(page.wait_for("breeding", [](const json& now) { return now["individuals"][0].contains("missing"); }));
  EXPECT_THAT(page.breeding()["problem"].get<std::string>(), HasSubstr("another text of the grammar"));
  EXPECT_THAT(page.ask("breed"), HasSubstr("another text of the grammar"));
  EXPECT_THAT(page.ask("ask_individual", {{"individual", id}}), HasSubstr("another text of the grammar"));
  EXPECT_EQ(page.ask("edit", {{"label", "back"}, {"grammar", before}}), "");
  ASSERT_TRUE(page.wait_for("breeding", [](const json& now) { return !now.contains("problem"); }));
  EXPECT_EQ(page.ask("breed"), "");
  const std::string project = std::to_string(page.seen["document"]["project"]["id"].get<int>());
  EXPECT_EQ(http("GET /projects/" + project + "/breeding/1/replay").body,
            "3 generations with 36 individuals came out the same\n");
}

}  // namespace
}  // namespace espalier::studio
