#pragma once
// A studio with a project in which people breed, over a real socket.

#include <cstdint>
#include <memory>
#include <string>

#include <gmock/gmock.h>

#include "run/temporary_folder.h"
#include "studio/breeding_page.h"
#include "studio/studio.h"
#include "studio/web_guard.h"

namespace espalier::studio {

using nlohmann::json;

class BreedingTest : public testing::Test {
 protected:
  BreedingTest() { start(); }
  void start() {
    server_.reset();
    studio_.reset();
    studio_ = std::make_unique<Studio>(folder_.file("studio.sqlite"));
    server_ =
        std::make_unique<WebServer>(WebServerSettings{.token = token_, .page_folder = folder_.file("page")}, *studio_);
  }
  std::unique_ptr<BreedingPage> page() { return std::make_unique<BreedingPage>(server_->port(), token_); }
  /// A page with a project of that sample.
  std::unique_ptr<BreedingPage> project(const std::string& sample) {
    auto page = this->page();
    EXPECT_EQ(page->ask("create_project", {{"name", sample}, {"sample", sample}}), "");
    return page;
  }
  std::string begin(BreedingPage& page, json settings = json::object(), const std::string& from = "nothing",
                    int seed = 7) {
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

inline json rating(std::int64_t individual, double rating) {
  return {{"ratings", {{{"individual", individual}, {"rating", rating}}}}};
}

inline json draw(std::int64_t individual, int index, double quantile) {
  return {{"individual", individual}, {"draws", {{{"gene", 0}, {"index", index}, {"quantile", quantile}}}}};
}

}  // namespace espalier::studio
