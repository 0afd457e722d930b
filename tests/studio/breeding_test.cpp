// The breeding room over a real socket, as a page sees it.
#include <chrono>
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

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

TEST_F(BreedingTest, AFirstScreenIsShownRatedAndBred) {
  const auto page_of = project("gentree-natural");
  BreedingPage& page = *page_of;
  ASSERT_TRUE(page.wait_for("breedings"));
  EXPECT_EQ(page.seen["breedings"]["sessions"].size(), 0u);
  auto began = std::chrono::steady_clock::now();
  ASSERT_EQ(begin(page), "");
  RecordProperty("first_screen", std::to_string(seconds_since(began)));
  printf("first screen %.3f s\n", seconds_since(began));
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
  began = std::chrono::steady_clock::now();
  EXPECT_EQ(page.ask("rate", {{"ratings", {{{"individual", first[2]}, {"rating", 3}}, {{"individual", first[5]}, {"rating", -1}}}}}), "");
  printf("rating %.3f s\n", seconds_since(began));
  EXPECT_EQ(page.individual(first[2])["rating"], 3);
  EXPECT_EQ(page.breeding()["undo"], "Rate some");
  began = std::chrono::steady_clock::now();
  EXPECT_EQ(page.ask("breed"), "");
  printf("bred %.3f s\n", seconds_since(began));
  ASSERT_TRUE(page.wait_for_models());
  printf("bred and shown %.3f s\n", seconds_since(began));
  EXPECT_EQ(page.breeding()["generation"], 2);
  EXPECT_EQ(page.breeding()["generations"][1]["parent"], 1);
  const json kept = page.breeding()["individuals"][0];
  EXPECT_EQ(kept["origin"], "kept");
  EXPECT_EQ(kept["parents"], json::array({first[2]}));
  EXPECT_EQ(kept["rating"], 3);
  EXPECT_EQ(page.models[kept["id"]].substr(24 + 32), page.models[first[2]].substr(24 + 32));
}

}  // namespace
}  // namespace espalier::studio
