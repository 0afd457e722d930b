#pragma once
// A page in the breeding room, over a real socket.

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "studio/web_client.h"

namespace espalier::studio {

inline std::uint32_t word_in(const std::string& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  if (offset + 4 <= bytes.size()) std::memcpy(&value, bytes.data() + offset, 4);
  return value;
}

class BreedingPage {
 public:
  using json = nlohmann::json;

  BreedingPage(std::uint16_t port, const std::string& token) : client_(port, token) { wait_for("projects"); }

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
  /// Until the newest model of every individual that is shown is there.
  bool wait_for_models() {
    const auto all_there = [&] {
      for (const json& one : seen["breeding"]["individuals"]) {
        const std::int64_t id = one["id"];
        if (one.contains("missing")) continue;
        if (bred.count(id) == 0 || bred[id]["version"] != one["version"] || bred[id]["session"] != session()["id"])
          return false;
      }
      return true;
    };
    while (!all_there()) {
      if (!read()) return false;
    }
    return true;
  }

  json& breeding() { return seen["breeding"]; }
  json& session() { return breeding()["session"]; }
  std::vector<std::int64_t> ids() {
    std::vector<std::int64_t> all;
    for (const json& one : breeding()["individuals"]) all.push_back(one["id"]);
    return all;
  }
  const json& individual(std::int64_t id) {
    for (const json& one : breeding()["individuals"]) {
      if (one["id"] == id) return one;
    }
    static const json nothing;
    return nothing;
  }
  WebSocketClient& client() { return client_; }

  std::map<std::string, json> seen;             // the newest of each kind
  std::map<std::int64_t, json> bred;            // by individual
  std::map<std::int64_t, std::string> models;   // ESPI by individual
  std::string meshes;                           // the room's
  int sent_models = 0;

 private:
  bool read() {
    const auto message = client_.read(60'000);
    if (!message) return false;
    last_ = nullptr;
    if (message->binary) {
      const std::string letters = message->bytes.substr(0, 4);
      if (letters == "ESPI") models[word_in(message->bytes, 12)] = message->bytes, ++sent_models;
      if (letters == "ESPG" && (word_in(message->bytes, 8) & 0x80000000u)) meshes = message->bytes;
      return true;
    }
    last_ = json::parse(message->bytes);
    const std::string kind = last_["kind"];
    if (kind == "bred") bred[last_["individual"]] = last_;
    seen[kind] = last_;
    return true;
  }

  WebSocketClient client_;
  json last_;
  int number_ = 0;
};

}  // namespace espalier::studio
