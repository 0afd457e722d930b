#pragma once
// A page in the breeding room, over a real socket.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "studio/page.h"

namespace espalier::studio {

class BreedingPage final : public Page {
 public:
  using Page::Page;

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

  std::map<std::int64_t, json> bred;            // by individual
  std::map<std::int64_t, std::string> models;   // ESPI by individual
  std::string meshes;                           // the room's
  int sent_models = 0;

 private:
  void took(const std::string& letters, const std::string& bytes) override {
    if (letters == "ESPI") models[word_at(bytes, 12)] = bytes, ++sent_models;
    if (letters == "ESPG" && (word_at(bytes, 8) & 0x80000000u)) meshes = bytes;
  }
  void took(const json& message) override {
    if (message["kind"] == "bred") bred[message["individual"]] = message;
  }
};

}  // namespace espalier::studio
