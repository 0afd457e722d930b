#include "studio_types.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace espalier::api {
namespace {

using testing::HasSubstr;

Request read(std::string_view text) {
  std::optional<std::int64_t> request;
  return read_request(text, request);
}

std::string error_of(std::string_view text) {
  try {
    read(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Api, RequestsReadBackEqual) {
  const std::vector<Request> requests = {
      ListProjects{}, OpenProject{.request = 7, .project = 3}, CreateProject{.name = "Ünïcode \"quoted\"\n", .sample = "tree"},
      Edit{.label = "Move", .gesture = "g1", .grammar = "grammar a 1", .scene = Scene{R"({"curves":{"curve":[]},"x":1.5})"}, .search = true},
      StartSearch{.seconds = 0.25, .onward = true, .from = StartSearchFrom::shown},
      SetDraw{.gene = 4, .model = 9, .index = 1, .quantile = 0.125},
      StartBreeding{.settings = {.method = RoomSettingsMethod::classic, .strength = 0.5, .classic = GenesisKnobs{.window = 5}},
                    .from = StartBreedingFrom::favourites, .seed = 7},
      Rate{.ratings = {{.individual = 3, .rating = -2.5}, {.individual = 4}}, .gesture = "keys"},
      SetGenes{.individual = 3, .draws = {{.gene = 1, .index = 2, .quantile = 1}}},
      LockDraws{.draws = {{.path = "Tree/Branch[2]", .index = 1}}, .locked = true},
      Blend{.parents = {1, 2, 3}, .weights = {1, 0.5, 0}, .keep = false}};
  for (const Request& request : requests) EXPECT_EQ(read(to_text(request)), request) << to_text(request);
}

TEST(Api, BadRequestsNameThePlaceTheRuleAndTheValue) {
  EXPECT_THAT(error_of("{"), HasSubstr("must be JSON"));
  EXPECT_THAT(error_of("[1]"), HasSubstr("must be an object, got [1]"));
  EXPECT_THAT(error_of("{}"), HasSubstr("must have a kind"));
  EXPECT_THAT(error_of(R"({"kind":"fly"})"), HasSubstr("no such kind: fly"));
  EXPECT_EQ(error_of(R"({"kind":"open_project"})"), "open_project: must have project");
  EXPECT_EQ(error_of(R"({"kind":"open_project","project":"a"})"), "open_project.project: must be a number, got \"a\"");
  EXPECT_EQ(error_of(R"({"kind":"open_project","project":1.5})"), "open_project.project: must be a whole number, got 1.5");
  EXPECT_EQ(error_of(R"({"kind":"open_project","project":1,"speed":2})"), "open_project: no such key: speed");
  EXPECT_EQ(error_of(R"({"kind":"start_search","seconds":0})"), "start_search.seconds: must be 0.01 .. 86400, got 0");
  EXPECT_THAT(error_of(R"({"kind":"start_search","seconds":1,"from":"above"})"),
              HasSubstr("must be one of nothing, shown, got \"above\""));
  EXPECT_THAT(error_of(R"({"kind":"edit","label":")" + std::string(300, 'x') + "\"}"),
              HasSubstr("edit.label: must have at most 200 bytes, got 300"));
  EXPECT_EQ(error_of(R"({"kind":"edit","label":{}})"), "edit.label: must be a text, got {}");
  EXPECT_EQ(error_of(R"({"kind":"edit","label":"a","scene":[]})"), "edit.scene: must be an object, got []");
  EXPECT_THAT(error_of(R"({"kind":"edit","label":"a","scene":{"a":)" + std::string(100000, '[')), HasSubstr("deeper than 64"));
  EXPECT_EQ(error_of(R"({"kind":"rate","ratings":[{"individual":1,"rating":1e9}]})"),
            "rate.ratings[0].rating: must be -1000 .. 1000, got 1000000000.0");
  EXPECT_EQ(error_of(R"({"kind":"start_breeding","from":"nothing","settings":{"population":200}})"),
            "start_breeding.settings.population: must be 9 .. 20, got 200");
  EXPECT_THAT(error_of(R"({"kind":"edit","label":"a","request":"x"})"), HasSubstr("message.request: must be a number"));
}

TEST(Api, TheNumberOfARequestIsKnownEvenIfTheRestIsBad) {
  std::optional<std::int64_t> request;
  EXPECT_THROW(read_request(R"({"kind":"open_project","request":12})", request), Error);
  EXPECT_EQ(request, 12);
}

TEST(Api, MessagesSayTheirKindAndLeaveOutWhatIsNotThere) {
  EXPECT_EQ(to_text(Failed{.request = 3, .text = "no"}), R"({"kind":"failed","request":3,"text":"no"})");
  EXPECT_EQ(to_text(Checked{.revision = 1, .problems = {{.severity = ProblemSeverity::warning, .code = "W1", .text = "t"}}}),
            R"({"kind":"checked","revision":1,"problems":[{"severity":"warning","code":"W1","text":"t"}],"symbols":[],"attributes":[]})");
}

}  // namespace
}  // namespace espalier::api
