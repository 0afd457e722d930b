#pragma once
// A studio with a project in which people breed, over a real socket.

#include <cstdint>
#include <memory>
#include <string>

#include "studio/breeding_page.h"
#include "studio/studio_fixture.h"

namespace espalier::studio {

using nlohmann::json;

class BreedingTest : public StudioFixture {
 protected:
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
};

inline json rating(std::int64_t individual, double rating) {
  return {{"ratings", {{{"individual", individual}, {"rating", rating}}}}};
}

inline json draw(std::int64_t individual, int index, double quantile) {
  return {{"individual", individual}, {"draws", {{{"gene", 0}, {"index", index}, {"quantile", quantile}}}}};
}

}  // namespace espalier::studio
