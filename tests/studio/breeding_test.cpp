// The breeding room over a real socket, as a page sees it.
#include <set>

#include <gmock/gmock.h>

#include "base/executor.h"
#include "search/genesis_encoding.h"
#include "studio/breeding_bench.h"
#include "studio/breeding_fixture.h"
#include "studio/shipped.h"

namespace espalier::studio {
namespace {

using testing::HasSubstr;

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
    EXPECT_EQ(word_at(model, 8), page.session()["id"]);
    EXPECT_EQ(word_at(model, 16), page.individual(id)["version"]);
    EXPECT_EQ(word_at(model, 20), word_at(page.meshes, 8));
    EXPECT_EQ(model.size(), 64 + 32 * word_at(model, 24) + 48 * word_at(model, 28));
    different.insert(model.substr(24));
  }
  EXPECT_EQ(different.size(), 12u);

  const std::vector<std::int64_t> first = page.ids();
  EXPECT_EQ(
      page.ask("rate",
               {{"ratings", {{{"individual", first[2]}, {"rating", 3}}, {{"individual", first[5]}, {"rating", -1}}}}}),
      "");
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
  EXPECT_EQ(page.models[kept["id"]].substr(24), page.models[first[2]].substr(24));
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
  EXPECT_NE(page.models[first[1]].substr(24), before.substr(24));
  const std::string after = page.models[first[1]];
  EXPECT_EQ(page.ask("undo_breeding"), "");
  ASSERT_TRUE(page.wait_for_models());
  EXPECT_FALSE(page.individual(first[1])["edited"]);
  EXPECT_EQ(page.models[first[1]].substr(24), before.substr(24));
  EXPECT_EQ(page.ask("redo_breeding"), "");
  ASSERT_TRUE(page.wait_for_models());
  EXPECT_EQ(page.models[first[1]].substr(24), after.substr(24));

  EXPECT_EQ(page.ask("compare", {{"better", first[2]}, {"worse", first[3]}}), "");
  EXPECT_EQ(page.individual(first[2])["rating"], 1);
  EXPECT_EQ(page.individual(first[3])["rating"], -1);
  EXPECT_EQ(page.breeding()["compared"], json::array({{{"better", first[2]}, {"worse", first[3]}}}));
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
  const json paste = {
      {"individual", id},
      {"draws", {{{"gene", 0}, {"index", 1}, {"quantile", 0.25}}, {{"gene", 0}, {"index", 3}, {"quantile", 0.75}}}}};
  EXPECT_EQ(page.ask("set_genes", paste), "");
  EXPECT_EQ(page.ask("lock_draws", {{"draws", {{{"path", "Tree"}, {"index", 1}}, {{"path", "Tree"}, {"index", 3}}}},
                                    {"locked", true}}),
            "");
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
  for (const auto& [mode, rates, edits] : {std::tuple{"rate_and_edit", true, true},
                                           {"rate", true, false},
                                           {"edit", false, true},
                                           {"neither", false, false}}) {
    ASSERT_EQ(begin(page, {{"mode", mode}, {"population", 9}}), "");
    const std::int64_t id = page.ids()[0];
    EXPECT_EQ(page.ask("rate", rating(id, 1)) == "", rates) << mode;
    EXPECT_EQ(page.ask("compare", {{"better", id}, {"worse", page.ids()[1]}}) == "", rates) << mode;
    EXPECT_EQ(page.ask("set_genes", draw(id, 0, 0.4)) == "", edits) << mode;
    EXPECT_EQ(page.ask("blend", {{"parents", page.ids()}, {"weights", {1}}, {"keep", true}}) == "", false);
    EXPECT_EQ(page.ask("blend", {{"parents", {id, page.ids()[1]}}, {"weights", {1, 1}}, {"keep", true}}) == "", edits)
        << mode;
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
  EXPECT_EQ(page.ask("set_breeding", {{"settings", {{"method", "free"}}}}),
            "a session keeps its method: begin another one from its individuals");
  const std::vector<std::int64_t> first = page.ids();
  EXPECT_EQ(
      page.ask("rate",
               {{"ratings", {{{"individual", first[3]}, {"rating", 4}}, {{"individual", first[8]}, {"rating", 2}}}}}),
      "");
  EXPECT_EQ(page.ask("set_breeding", {{"settings", {{"classic", {{"gray", false}, {"selection", "rank"}}}}}}), "");
  EXPECT_EQ(page.ask("breed"), "");
  EXPECT_EQ(page.breeding()["individuals"].size(), 20u);
  EXPECT_FALSE(page.breeding()["settings"]["classic"]["gray"]);
  bool elite = false;
  for (const json& one : page.breeding()["individuals"])
    elite = elite || (one["parents"] == json::array({first[3]}) && one.value("rating", 0.0) == 4);
  EXPECT_TRUE(elite);
  const auto other = project("city");
  EXPECT_THAT(begin(*other, {{"method", "classic"}}), HasSubstr("draws of the start rule"));
}

TEST(BreedingSample, GenTreeHasItsBits) {
  const auto bits_of = [](const char* sample) {
    const NewProject project = make_sample(sample);
    const auto executor = make_serial_executor();
    BreedingBench bench([&](const std::string& hash) { return project.blobs.at(hash); }, *executor);
    bench.take(project.state);
    return GenesisEncoding(bench.graph(), bench.genesis_bits(), true).length();
  };
  EXPECT_EQ(bits_of("gentree"), 82u);
  EXPECT_GT(bits_of("gentree-natural"), 82u);
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
  EXPECT_TRUE(
      one->wait_for("breeding", [&](const json& now) { return now["individuals"][3].value("rating", 0) == 2; }));
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

/// What judges candidates hands their models on; a session that is opened grows them from their texts.
TEST_F(BreedingTest, AModelIsTheSameWhetherJudgedOrGrownAgain) {
  for (const char* sample : {"gentree-natural", "arboretum", "modular-house"}) {
    auto page = project(sample);
    ASSERT_EQ(begin(*page, {{"population", 9}}), "");
    ASSERT_EQ(page->ask("breed", {}), "");
    ASSERT_TRUE(page->wait_for_models());
    const std::int64_t session = page->session()["id"];
    const std::vector<std::int64_t> shown = page->ids();
    const auto bred = page->bred;
    const auto models = page->models;
    ASSERT_EQ(page->ask("leave_breeding", {}), "");
    page->bred.clear();
    page->models.clear();
    ASSERT_EQ(page->ask("open_breeding", {{"session", session}}), "");
    ASSERT_TRUE(page->wait_for_models());
    ASSERT_EQ(page->ids(), shown);
    for (const std::int64_t id : shown) {
      constexpr std::size_t kVersionAt = 16, kModelAt = 24;
      std::string before = models.at(id), after = page->models.at(id);
      before.replace(kVersionAt, 4, 4, '\0'), after.replace(kVersionAt, 4, 4, '\0');
      before.replace(kModelAt + 8, 4, 4, '\0'), after.replace(kModelAt + 8, 4, 4, '\0');
      EXPECT_TRUE(before == after) << sample << " " << id;
      json was = bred.at(id), is = page->bred.at(id);
      was.erase("version"), is.erase("version");
      EXPECT_EQ(was, is) << sample << " " << id;
    }
  }
}

TEST_F(BreedingTest, AFavouriteIsKeptAndShownAndBredFrom) {
  const auto owned = project("gentree-natural");
  BreedingPage& page = *owned;
  EXPECT_EQ(page.ask("start_breeding", {{"settings", json::object()}, {"from", "favourites"}}),
            "the project has no favourites");
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
  EXPECT_EQ(page.models[page.ids()[0]].substr(24), model.substr(24)) << "a founder comes first, as it is";
  std::size_t relatives = 0;
  for (const json& one : page.breeding()["individuals"]) {
    if (one["origin"] != "sibling") continue;
    ++relatives;
    EXPECT_EQ(one["parents"], json::array({page.ids()[0]}));
  }
  EXPECT_EQ(relatives, 7u) << "two thirds of the other 11 places";
  const std::string project = std::to_string(page.seen["document"]["project"]["id"].get<int>());
  EXPECT_EQ(http("GET /projects/" + project + "/breeding/2/replay").body, "1 generation with 12 individuals came out the same\n");
  ASSERT_EQ(begin(page, json::object(), "shown"), "");
  EXPECT_EQ(page.models[page.ids()[0]].substr(24), model.substr(24));
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
  EXPECT_THAT(
      page.ask("rate", {{"ratings", {{{"individual", id}, {"rating", 1}}, {{"individual", 0}, {"rating", 1}}}}}),
      HasSubstr("not one"));
  EXPECT_THAT(page.ask("rate", {{"ratings", {{{"individual", id}, {"rating", nullptr}}}}}),
              HasSubstr("must be a number"));
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
  EXPECT_THAT(
      page.ask("start_breeding", {{"settings", {{"population", 9}, {"max_triangles", 1}}}, {"from", "nothing"}}),
      HasSubstr("viable"));
  page.seen.erase("breeding");
  EXPECT_EQ(page.ask("open_breeding", {{"session", 1}}), "");
  json after = page.breeding();
  EXPECT_EQ(after["individuals"], before["individuals"]);
  EXPECT_EQ(after["revision"], before["revision"]);
  EXPECT_FALSE(after.contains("undo"));
}

}  // namespace
}  // namespace espalier::studio
