#pragma once
// A studio with a server of its own, and nobody in it yet.

#include <memory>
#include <string>

#include <gmock/gmock.h>

#include "run/temporary_folder.h"
#include "studio/studio.h"
#include "studio/web_client.h"
#include "studio/web_guard.h"

namespace espalier::studio {

class StudioFixture : public testing::Test {
 protected:
  StudioFixture() { start(); }
  /// Also again, with the same projects.
  void start() {
    server_.reset();
    studio_.reset();
    studio_ = std::make_unique<Studio>(folder_.file("studio.sqlite"));
    server_ =
        std::make_unique<WebServer>(WebServerSettings{.token = token_, .page_folder = folder_.file("page")}, *studio_);
  }
  Answer http(const std::string& request, const std::string& body = "") {
    return ask(server_->port(), request, "X-Espalier-Token: " + token_ + "\r\n", body);
  }

  TemporaryFolder folder_;
  std::string token_ = make_token();
  std::unique_ptr<Studio> studio_;
  std::unique_ptr<WebServer> server_;
};

}  // namespace espalier::studio
