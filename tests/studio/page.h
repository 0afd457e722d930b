#pragma once
// A page of the studio, over a real socket.

#include <cstdint>
#include <cstring>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "studio/web_client.h"

namespace espalier::studio {

inline std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  if (offset + 4 <= bytes.size()) std::memcpy(&value, bytes.data() + offset, 4);
  return value;
}

/// What one page has seen: the newest message of each kind.
class Page {
 public:
  using json = nlohmann::json;

  Page(std::uint16_t port, const std::string& token) : client_(port, token) { wait_for("projects"); }
  virtual ~Page() = default;
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  /// Sends a request and reads on to its answer, "" or why it failed.
  std::string ask(const std::string& kind, json request = json::object()) {
    const int number = send(kind, std::move(request));
    while (read()) {
      if ((last_["kind"] == "done" || last_["kind"] == "failed") && last_.value("request", 0) == number)
        return last_.value("text", "");
    }
    return "the connection ended";
  }
  /// Sends it only; its number.
  int send(const std::string& kind, json request = json::object()) {
    request["kind"] = kind;
    request["request"] = ++number_;
    client_.send_frame(request.dump());
    return number_;
  }
  /// Reads until a message of that kind passes; false where none comes.
  template <class Passes>
  bool wait_for(const std::string& kind, Passes passes) {
    if (seen.count(kind) != 0 && passes(seen[kind])) return true;
    while (read()) {
      if (last_.is_object() && last_["kind"] == kind && passes(last_)) return true;
    }
    return false;
  }
  bool wait_for(const std::string& kind) {
    return wait_for(kind, [](const json&) { return true; });
  }
  WebSocketClient& client() { return client_; }

  std::map<std::string, json> seen;

 protected:
  bool read() {
    const auto message = client_.read(60'000);
    if (!message) return false;
    last_ = nullptr;
    if (message->binary) {
      took(message->bytes.substr(0, 4), message->bytes);
      return true;
    }
    last_ = json::parse(message->bytes);
    seen[last_["kind"].get<std::string>()] = last_;
    took(last_);
    return true;
  }

 private:
  virtual void took(const std::string&, const std::string&) {}  // four letters, and all bytes
  virtual void took(const json&) {}

  WebSocketClient client_;
  json last_;
  int number_ = 0;
};

}  // namespace espalier::studio
