#include "studio/web_server.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>

#include "base/error.h"
#include "run/temporary_folder.h"
#include "studio/web_client.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

using testing::HasSubstr;

/// Sends every text back; a request's answer is its method, path and body.
class Echo final : public WebApp {
 public:
  void opened(const WebSocketPtr& socket) override {
    ++open;
    const std::lock_guard lock(mutex);
    last = socket;
  }
  void received(const WebSocketPtr& socket, std::string text) override { socket->out.push_text(std::move(text)); }
  void closed(const WebSocketPtr&) override { --open; }
  HttpResponse answer(const HttpRequest& request) override {
    if (request.path == "/bad") throw Error("it is bad");
    return {200, "text/plain", request.method + " " + request.path + " " + request.body};
  }

  std::atomic<int> open{0};
  std::mutex mutex;
  WebSocketPtr last;
};

class WebServerTest : public testing::Test {
 protected:
  WebServerTest() {
    std::filesystem::create_directories(folder_.file("page/assets"));
    std::ofstream(folder_.file("page/index.html")) << "<!doctype html>the page";
    std::ofstream(folder_.file("page/assets/a.js")) << "script";
    std::ofstream(folder_.file("secret.txt")) << "secret";
    std::ofstream(folder_.file("page/.hidden.txt")) << "secret";
    std::filesystem::create_symlink(folder_.file("secret.txt"), folder_.file("page/link.txt"));
    server_ = std::make_unique<WebServer>(
        WebServerSettings{.token = token_, .page_folder = folder_.file("page"), .most_sockets = 4,
                          .most_frame_bytes = 10'000, .most_body_bytes = 1000},
        echo_);
  }

  std::uint16_t port() const { return server_->port(); }
  std::string with_token() const { return "X-Espalier-Token: " + token_ + "\r\n"; }

  TemporaryFolder folder_;
  Echo echo_;
  std::string token_ = make_token();
  std::unique_ptr<WebServer> server_;
};

TEST_F(WebServerTest, ServesThePageWithHeadersThatGuardIt) {
  const Answer page = ask(port(), "GET /");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<!doctype html>the page");
  EXPECT_THAT(page.head, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self';"));
  EXPECT_THAT(page.head, HasSubstr(fmt::format("connect-src 'self' ws://localhost:{0} ws://127.0.0.1:{0};", port())));
  EXPECT_THAT(page.head, HasSubstr("nosniff"));
  EXPECT_THAT(page.head, testing::Not(HasSubstr("Access-Control")));
  EXPECT_EQ(ask(port(), "GET /assets/a.js").body, "script");
}

TEST_F(WebServerTest, NoPathLeadsOutOfThePage) {
  for (const char* path : {"/../secret.txt", "/assets/../../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/link.txt",
                           "/.hidden.txt", "//etc/passwd", "/assets", "/assets/", "/a.js%00.txt", "/..\\secret.txt"}) {
    const Answer answer = ask(port(), std::string("GET ") + path);
    EXPECT_NE(answer.status, 200) << path;
    EXPECT_THAT(answer.body, testing::Not(HasSubstr("secret\n"))) << path;
    EXPECT_NE(answer.body, "secret") << path;
  }
}

TEST_F(WebServerTest, WithoutAPageItSaysHowOneIsBuilt) {
  std::filesystem::remove_all(folder_.file("page"));
  const Answer answer = ask(port(), "GET /");
  EXPECT_EQ(answer.status, 200);
  EXPECT_THAT(answer.body, HasSubstr("script/studio"));
}

TEST_F(WebServerTest, OtherHostsOriginsAndTokensAreRefused) {
  EXPECT_EQ(ask(port(), "GET /", "", "", "evil.example").status, 403);
  EXPECT_EQ(ask(port(), "GET /", "", "", fmt::format("evil.example:{}", port())).status, 403);
  EXPECT_EQ(ask(port(), "GET /", "", "", "127.0.0.1:1").status, 403);
  EXPECT_EQ(ask(port(), "GET /", "", "", fmt::format("localhost:{}", port())).status, 200);
  EXPECT_EQ(ask(port(), "GET /", "", "", fmt::format("[::1]:{}", port())).status, 200);
  EXPECT_EQ(ask(port(), "GET /", "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(ask(port(), "GET /thing").status, 403);
  EXPECT_EQ(ask(port(), "GET /thing?token=" + std::string(64, '0')).status, 403);
  EXPECT_EQ(ask(port(), "GET /thing", with_token()).body, "GET /thing ");
  EXPECT_EQ(ask(port(), "GET /thing?token=" + token_).body, "GET /thing ");
  EXPECT_EQ(ask(port(), "PUT /thing", with_token()).status, 405);
}

TEST_F(WebServerTest, SocketsNeedTokenAndOrigin) {
  const std::string own = fmt::format("http://localhost:{}", port());
  EXPECT_EQ(WebSocketClient(port(), token_, own).status(), 101);
  EXPECT_EQ(WebSocketClient(port(), "").status(), 403);
  EXPECT_EQ(WebSocketClient(port(), std::string(64, 'a')).status(), 403);
  EXPECT_EQ(WebSocketClient(port(), token_, "http://evil.example").status(), 403);
  EXPECT_EQ(WebSocketClient(port(), token_, "null").status(), 403);
  EXPECT_EQ(WebSocketClient(port(), token_, own, "evil.example").status(), 403);
}

TEST_F(WebServerTest, BodiesAreBounded) {
  EXPECT_EQ(ask(port(), "POST /in", with_token(), std::string(1000, 'x')).body, "POST /in " + std::string(1000, 'x'));
  EXPECT_EQ(ask(port(), "POST /in", with_token(), std::string(1001, 'x')).status, 413);
  EXPECT_EQ(ask(port(), "POST /in", with_token() + "Content-Length: 99999999999999\r\n").status, 413);
  EXPECT_EQ(ask(port(), "POST /in", with_token() + "Transfer-Encoding: chunked\r\n").status, 411);
}

TEST_F(WebServerTest, ErrorsOfTheApplicationAreAnswers) {
  const Answer answer = ask(port(), "GET /bad", with_token());
  EXPECT_EQ(answer.status, 400);
  EXPECT_EQ(answer.body, "it is bad\n");
}

TEST_F(WebServerTest, TextsComeBackWholeOrInPieces) {
  WebSocketClient client(port(), token_);
  client.send_frame("hello");
  EXPECT_EQ(client.read()->bytes, "hello");
  client.send_frame("one ", 1, false);
  client.send_frame("two ", 0, false);
  client.send_frame("three", 0, true);
  EXPECT_EQ(client.read()->bytes, "one two three");
  const std::string large(9000, 'y');
  client.send_frame(large);
  EXPECT_EQ(client.read()->bytes, large);
}

TEST_F(WebServerTest, WhatIsTooLargeOrNoTextEndsTheConnection) {
  const auto ends_after = [&](auto send) {
    WebSocketClient client(port(), token_);
    send(client);
    return client.ends();
  };
  EXPECT_TRUE(ends_after([](WebSocketClient& client) { client.send_frame(std::string(10'001, 'x')); }));
  EXPECT_TRUE(ends_after([](WebSocketClient& client) {
    for (int i = 0; i < 3; ++i) client.send_frame(std::string(4000, 'x'), i == 0 ? 1 : 0, false);
  }));
  EXPECT_TRUE(ends_after([](WebSocketClient& client) { client.send_frame("x", 2); }));
  EXPECT_TRUE(ends_after([](WebSocketClient& client) { client.send_frame("x", 0); }));
  EXPECT_TRUE(ends_after([](WebSocketClient& client) {
    client.send_frame("x", 1, false);
    client.send_frame("y", 1, true);
  }));
}

TEST_F(WebServerTest, SocketsAreCountedAndPagesServedBesideThem) {
  std::vector<std::unique_ptr<WebSocketClient>> clients;
  for (int i = 0; i < 4; ++i) clients.push_back(std::make_unique<WebSocketClient>(port(), token_));
  for (const auto& client : clients) EXPECT_EQ(client->status(), 101);
  while (echo_.open < 4) std::this_thread::yield();
  EXPECT_EQ(WebSocketClient(port(), token_).status(), 503);
  EXPECT_EQ(ask(port(), "GET /").status, 200);
  clients.clear();
  while (echo_.open > 0) std::this_thread::yield();
  EXPECT_EQ(WebSocketClient(port(), token_).status(), 101);
}

TEST_F(WebServerTest, APageThatDoesNotReadGetsTheNewestModelOnly) {
  WebSocketClient client(port(), token_);
  client.send_frame("there");
  ASSERT_TRUE(client.read());
  WebSocketPtr socket;
  {
    const std::lock_guard lock(echo_.mutex);
    socket = echo_.last;
  }
  const auto meshes = std::make_shared<const std::string>("meshes");
  constexpr int kModels = 40;
  for (int i = 1; i <= kModels; ++i) {
    const auto model = std::make_shared<const std::string>(1'000'000, static_cast<char>(i));
    socket->out.push_model({1, meshes, model, std::make_shared<const std::string>(std::to_string(i))});
  }
  socket->out.push_text("end");
  int models = 0, last = 0;
  EXPECT_EQ(client.read()->bytes, "meshes");
  for (;;) {
    const auto message = client.read();
    ASSERT_TRUE(message);
    if (!message->binary) {
      ASSERT_EQ(message->bytes, "end");
      break;
    }
    ++models;
    const auto words = client.read();
    EXPECT_EQ(words->bytes, std::to_string(static_cast<int>(message->bytes[0])));
    last = message->bytes[0];
  }
  EXPECT_EQ(last, kModels);
  EXPECT_LT(models, kModels);
}

TEST(OutBox, GivesUpOnAPageThatLetsTextsPileUp) {
  OutBox box;
  for (std::size_t i = 0; i < OutBox::kMostTexts; ++i) box.push_text("x");
  EXPECT_FALSE(box.closed());
  box.push_text("x");
  EXPECT_TRUE(box.closed());
  EXPECT_FALSE(box.take());
}

TEST(WebGuard, PlainPaths) {
  for (const char* good : {"a", "a/b.obj", "my mesh (2).glb", "shapes/box.obj"}) EXPECT_TRUE(is_plain_path(good)) << good;
  for (const char* bad : {"", "/a", "a/", "a//b", "..", "a/../b", ".a", "a/.b", "a\\b", "a\nb", "a%2e", " a", "\xc3\xa4"}) {
    EXPECT_FALSE(is_plain_path(bad)) << bad;
  }
  EXPECT_FALSE(is_plain_path(std::string(201, 'a')));
}

TEST(WebGuard, TokensAreLongAndDiffer) {
  EXPECT_EQ(make_token().size(), 64u);
  EXPECT_NE(make_token(), make_token());
}

}  // namespace
}  // namespace espalier::studio
