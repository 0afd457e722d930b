#include "base/base64.h"
#include "run/report.h"

#include <cmath>
#include <cstring>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "io/mesh_import.h"
#include "model/expand.h"
#include "model/parts.h"
#include "run/derivation_file.h"
#include "run/fixtures.h"
#include "run/report_page.h"
#include "run/report_text.h"
#include "run/run.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::decode_base64;
using testing::element_text;
using testing::expect_well_formed;
using testing::pile_scene;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_pile;
using testing::write_text;

std::string report_of(const TemporaryFolder& folder, const std::string& out = "out", int threads = 1) {
  AssimpMeshSource source;
  Scene scene = load_scene(folder / "scene.toml");
  scene.threads = threads;
  EXPECT_TRUE(run_scene(scene, {folder / out, nullptr, nullptr}, source));
  return read_text(folder / out + "/report.html");
}

TEST(ReportText, EscapesWhatHtmlWouldRead) {
  EXPECT_EQ(escape_html("<b a='1' c=\"2\">&amp;\n\x01"),
            "&lt;b a=&#39;1&#39; c=&quot;2&quot;&gt;&amp;amp;\n\xef\xbf\xbd");
  EXPECT_EQ(json_for_script("\"</script><!--&\""), "\"\\u003c/script\\u003e\\u003c!--\\u0026\"");
  EXPECT_EQ(url_component("a b/\xc3\xa4?#%-_.~"), "a%20b%2F%C3%A4%3F%23%25-_.~");
}

RC_GTEST_PROP(ReportText, Base64ReadsBack, (const std::string& bytes)) {
  RC_ASSERT(decode_base64(encode_base64(bytes)) == bytes);
}

TEST(ReportText, TemplatesAreFilledOnce) {
  EXPECT_EQ(fill_template("{{a}}-{{b}}-{{a}}", {{"a", "{{b}}"}, {"b", "2"}}), "{{b}}-2-{{b}}");
  EXPECT_DEATH(fill_template("{{c}}", {{"a", ""}}), "");
}

TEST(ReportText, NumbersAreGrouped) {
  for (const auto& [value, text] : std::vector<std::pair<double, std::string>>{
           {0, "0"}, {-0.0, "0"}, {999, "999"}, {1000, "1,000"}, {-1234567, "-1,234,567"}, {-3541.25, "-3,541.25"},
           {0.5, "0.5"}, {-123, "-123"}, {1e-9, "1e-09"}, {1e20, "1e+20"}, {123456.4, "123,456"}}) {
    EXPECT_EQ(readable_number(value), text);
  }
}

TEST(ReportText, PicturesAreMadeSmallerByMeans) {
  Picture picture;
  picture.width = 4, picture.height = 3;
  picture.rgb.assign(36, 0);
  for (std::size_t i = 0; i < 36; ++i) picture.rgb[i] = static_cast<std::uint8_t>(7 * i);
  EXPECT_EQ(shrunk(picture, 4).rgb, picture.rgb);
  const Picture half = shrunk(picture, 3);
  ASSERT_EQ(half.width, 2u);
  ASSERT_EQ(half.height, 1u);
  for (std::size_t x = 0; x < 2; ++x) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (const std::size_t at : {2 * x, 2 * x + 1, 2 * x + 4, 2 * x + 5}) {
        sum += std::pow(static_cast<double>(picture.rgb[3 * at + c]), 2) / 4;
      }
      EXPECT_NEAR(half.rgb[3 * x + c], std::sqrt(sum), 0.51);
    }
  }
  Picture white = picture;
  white.rgb.assign(36, 255);
  EXPECT_EQ(shrunk(white, 1).rgb, (std::vector<std::uint8_t>{255, 255, 255}));
}

TEST(Report, IsOneWellFormedPageThatAsksNobody) {
  const TemporaryFolder folder;
  write_pile(folder);
  const std::string page = report_of(folder);
  expect_well_formed(page);
  const std::regex asks("(https?|wss?|ftp):|//[a-z]|@import|url\\(|\\b(fetch|XMLHttpRequest|WebSocket|eval)\\(");
  // Comments of the script may hold "// words", addresses may not.
  const std::string code = std::regex_replace(testing::without_base64(page), std::regex("(^|[ \\n])//[^\\n]*"), "");
  std::smatch match;
  EXPECT_FALSE(std::regex_search(code, match, asks)) << match.str();
  const std::regex source("(src|href)=\"([^\"]{0,40})");
  int sources = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), source), end; at != end; ++at, ++sources) {
    const std::string value = (*at)[2];
    EXPECT_TRUE(value.starts_with("data:image/png;base64,") || value.starts_with("alternatives/")) << value;
  }
  EXPECT_GE(sources, 4);
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(Report, TheDataReadBack) {
  const TemporaryFolder folder;
  write_pile(folder);
  const std::string page = report_of(folder);
  const auto data = nlohmann::json::parse(element_text(page, "data"));
  const auto result = nlohmann::json::parse(read_text(folder / "out/result.json"));
  EXPECT_EQ(data["best"].size(), 6u);
  EXPECT_EQ(data["seconds"].size(), 6u);
  EXPECT_EQ(data["best"].back(), result["score"]);
  EXPECT_EQ(data["evaluations"].back(), result["evaluations"]);
  EXPECT_TRUE(data["live"].is_null());
  EXPECT_EQ(element_text(page, "settings"), escape_html(read_text(folder / "out/run.toml")));
  EXPECT_THAT(page, HasSubstr(escape_html(result["words"].get<std::string>())));
  for (const auto& [name, hash] : result["provenance"]["inputs"].items()) {
    EXPECT_THAT(page, HasSubstr(hash.get<std::string>())) << name;
  }
  for (const auto& term : result["targets"][0]["terms"]) {
    EXPECT_THAT(page, HasSubstr("<th scope=\"row\">" + escape_html(term["name"].get<std::string>()) + "</th>"));
  }
}

TEST(Report, TheModelReadsBack) {
  const TemporaryFolder folder;
  write_pile(folder);
  const std::string page = report_of(folder);
  AssimpMeshSource source;
  const LoadedDerivation loaded = load_derivation(folder / "out/best.derivation.json", "", {});
  Expander expander(*loaded.grammar.graph);
  Model model;
  expander.expand(loaded.derivation, ExpandTo::full, model);
  const Parts parts = collect_parts(model, load_meshes(loaded.grammar, source), true);
  std::size_t triangles = 0;
  for (const Part& part : parts.parts) triangles += parts.shapes[part.shape].mesh.triangles.size();
  ASSERT_GT(triangles, 0u);

  const auto header = nlohmann::json::parse(element_text(page, "data"))["model"];
  EXPECT_EQ(header["parts"], parts.parts.size());
  EXPECT_EQ(header["triangles"], triangles);
  EXPECT_EQ(header["targets"].size(), 1u);
  EXPECT_EQ(header["note"], "");
  const std::string bytes = decode_base64(element_text(page, "model"));
  std::size_t vertices = 0, corners = 0;
  for (const auto& shape : header["shapes"]) {
    vertices += shape[0].get<std::size_t>();
    corners += 3 * shape[1].get<std::size_t>();
  }
  ASSERT_EQ(bytes.size(), vertices * 20 + corners * 4 + parts.parts.size() * 56);
  const char* places = bytes.data() + vertices * 20 + corners * 4;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    float place[12];
    std::uint32_t kind[2];
    std::memcpy(place, places + 48 * i, sizeof place);
    std::memcpy(kind, places + 48 * parts.parts.size() + 8 * i, sizeof kind);
    const Frame& frame = parts.parts[i].model_from_shape;
    EXPECT_EQ(Vec3(place[0], place[1], place[2]), frame.basis[0]);
    EXPECT_EQ(Vec3(place[6], place[7], place[8]), frame.basis[2]);
    EXPECT_EQ(Vec3(place[9], place[10], place[11]), frame.origin);
    EXPECT_EQ(kind[0], parts.parts[i].shape);
    EXPECT_EQ(kind[1], parts.parts[i].material);
  }
}

TEST(Report, LargeModelsAreReducedAndThePageSaysSo) {
  const TemporaryFolder folder;
  write_pile(folder);
  report_of(folder);
  AssimpMeshSource source;
  const LoadedDerivation loaded = load_derivation(folder / "out/best.derivation.json", "", {});
  Expander expander(*loaded.grammar.graph);
  Model model;
  expander.expand(loaded.derivation, ExpandTo::full, model);
  const MeshTable meshes = load_meshes(loaded.grammar, source);
  const Parts parts = collect_parts(model, meshes, true);
  ASSERT_GT(parts.parts.size(), 2u);
  ReportBudget budget;
  budget.triangles = 24;  // two boxes
  const ReportModel two = make_report_model(model, meshes, loaded.grammar.graph->materials, {}, budget);
  EXPECT_EQ(two.triangles, 24u);
  EXPECT_EQ(two.note, "The model is too large for a page: 2 of its " + std::to_string(parts.parts.size()) +
                          " parts are shown, the largest.");
  budget = {};
  budget.model_bytes = 10, budget.target_bytes = 10;
  const Mesh target = source.load(folder / "meshes/tower.obj");
  const ReportModel none = make_report_model(model, meshes, loaded.grammar.graph->materials, {target}, budget);
  EXPECT_TRUE(none.bytes.empty());
  EXPECT_THAT(none.note, HasSubstr("0 of its"));
  EXPECT_THAT(none.note, HasSubstr("1 of 1 target meshes are too large for a page and left out."));
}

TEST(Report, NamesMayHoldAnything) {
  const TemporaryFolder folder;
  write_pile(folder);
  const std::string nasty = "a&b '</script><script>alert(1)<!-- \"{{data}}.obj";
  std::string file = nasty;
  for (std::size_t at; (at = file.find('/')) != std::string::npos;) file.replace(at, 1, "|");
  write_text(folder / ("meshes/" + file), testing::box_obj(-1, 0, -0.5, 1, 4, 0.5));
  std::string scene = pile_scene();
  const std::string old = "\"meshes/tower.obj\"";
  std::string quoted;
  for (const char c : file) quoted += c == '"' ? std::string("\\\"") : std::string(1, c);
  scene.replace(scene.find(old), old.size(), "\"meshes/" + quoted + "\"");
  write_text(folder / "scene.toml", scene);
  const std::string page = report_of(folder, "out <&> \"x'");
  expect_well_formed(page);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("{{data}}.obj"));
}

TEST(Report, SameResultsSameBytesButForTimes) {
  const TemporaryFolder folder;
  write_pile(folder);
  const std::string one = report_of(folder, "one", 1), two = report_of(folder, "two", 3);
  EXPECT_EQ(testing::without_report_times(one), testing::without_report_times(two));
  EXPECT_LT(testing::without_report_times(one).size(), one.size());
}

TEST(Report, LongSearchesAreThinnedOut) {
  const TemporaryFolder folder;
  write_pile(folder, pile_scene("generations = 4000"));
  const auto data = nlohmann::json::parse(element_text(report_of(folder), "data"));
  EXPECT_GT(data["best"].size(), 1000u);
  EXPECT_LT(data["best"].size(), 1510u);
  EXPECT_EQ(data["best"].back(), nlohmann::json::parse(read_text(folder / "out/result.json"))["score"]);
}

}  // namespace
}  // namespace espalier
