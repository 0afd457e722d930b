#pragma once
// WebServer: HTTP and one WebSocket on the loopback interface, for pages that know its token. The library behind it is
// seen by web_server.cpp alone. Every request is held against the rules of web_guard.h before the application sees it.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "studio/outbox.h"

namespace espalier::studio {

struct HttpRequest {
  std::string method;  // GET or POST
  std::string path;    // decoded, begins with /
  std::string body;
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::string file_name = {};  // to be kept under; empty: to be shown
};

/// One page's connection. Messages to it go through its box.
struct WebSocket {
  std::uint64_t number = 0;
  OutBox out;
};
using WebSocketPtr = std::shared_ptr<WebSocket>;

/// What is served. Called on the server's threads, several at once; of one socket one call at a time, `closed` last.
class WebApp {
 public:
  virtual ~WebApp() = default;
  virtual void opened(const WebSocketPtr& socket) = 0;
  virtual void received(const WebSocketPtr& socket, std::string text) = 0;
  virtual void closed(const WebSocketPtr& socket) = 0;
  /// Of a request that carried the token.
  virtual HttpResponse answer(const HttpRequest& request) = 0;
  /// The server ends: answers that are being made are not waited for for long.
  virtual void ending() {}
};

struct WebServerSettings {
  std::uint16_t port = 0;  // 0: any that is free
  std::string token;
  std::string page_folder;
  int most_sockets = 32;
  std::size_t most_frame_bytes = 8u << 20;   // of a message, all its frames together
  std::size_t most_body_bytes = 96u << 20;
};

class WebServer {
 public:
  /// Serves at once. `app` must outlive it. Throws Error, where the port is taken for one.
  WebServer(WebServerSettings settings, WebApp& app);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  std::uint16_t port() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace espalier::studio
