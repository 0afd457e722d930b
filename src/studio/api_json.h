#pragma once
// What the types made from api/studio.json are read and written with. Internal to them; includes a heavy header.

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <studio_types.h>

#include "base/error.h"

namespace espalier::api {

using Json = nlohmann::ordered_json;

inline constexpr std::size_t kMostItems = 100'000;
inline constexpr int kMostDepth = 64;  // of lists and objects within each other

[[noreturn]] inline void fail_at(const std::string& path, const std::string& rule, const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 80) text = text.substr(0, 77) + "...";
  throw Error(fmt::format("{}: {}, got {}", path, rule, text));
}

inline Json parse_object(std::string_view text) {
  const auto bounded = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kMostDepth) throw Error(fmt::format("message: must not be nested deeper than {}", kMostDepth));
    return true;
  };
  Json json = Json::parse(text, bounded, false);
  if (json.is_discarded()) throw Error("message: must be JSON");
  if (!json.is_object()) fail_at("message", "must be an object", json);
  return json;
}

inline std::string read_kind(const Json& json) {
  const auto it = json.find("kind");
  if (it == json.end() || !it->is_string()) throw Error("message: must have a kind, a text");
  return it->get<std::string>();
}

[[noreturn]] inline void fail_kind(const std::string& kind) {
  throw Error(fmt::format("message: no such kind: {}", kind.substr(0, 80)));
}

inline void require_object(const Json& json, const std::string& path) {
  if (!json.is_object()) fail_at(path, "must be an object", json);
}

inline void require_keys(const Json& json, std::span<const std::string_view> keys, const std::string& path) {
  for (const auto& [key, value] : json.items()) {
    bool known = false;
    for (std::string_view name : keys) known = known || name == key;
    if (!known) throw Error(fmt::format("{}: no such key: {}", path, key.substr(0, 80)));
  }
}

/// Null where it is absent and may be.
inline const Json* member(const Json& json, const char* key, const std::string& path, bool required) {
  const auto it = json.find(key);
  if (it != json.end()) return &*it;
  if (required) throw Error(fmt::format("{}: must have {}", path, key));
  return nullptr;
}

inline void read(const Json& json, double& out, const std::string& path, double least = -1e300, double most = 1e300) {
  if (!json.is_number()) fail_at(path, "must be a number", json);
  out = json.get<double>();
  if (!(out >= least && out <= most)) fail_at(path, fmt::format("must be {} .. {}", least, most), json);
}

inline void read(const Json& json, std::int64_t& out, const std::string& path, double least = -9007199254740991.0,
                 double most = 9007199254740991.0) {
  double number = 0;
  read(json, number, path, least, most);
  if (std::floor(number) != number) fail_at(path, "must be a whole number", json);
  out = static_cast<std::int64_t>(number);
}

inline void read(const Json& json, bool& out, const std::string& path) {
  if (!json.is_boolean()) fail_at(path, "must be true or false", json);
  out = json.get<bool>();
}

inline void read(const Json& json, std::string& out, const std::string& path, std::size_t most = 10000) {
  if (!json.is_string()) fail_at(path, "must be a text", json);
  out = json.get<std::string>();
  if (out.size() > most) throw Error(fmt::format("{}: must have at most {} bytes, got {}", path, most, out.size()));
}

inline void read(const Json& json, JsonText& out, const std::string& path) {
  require_object(json, path);
  out.text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <class E>
void read_enum(const Json& json, E& out, std::initializer_list<std::string_view> names, const std::string& path) {
  std::string rule = "must be one of";
  std::size_t index = 0;
  for (std::string_view name : names) {
    if (json == name) {
      out = static_cast<E>(index);
      return;
    }
    rule += fmt::format("{} {}", index++ ? "," : "", name);
  }
  fail_at(path, rule, json);
}

template <class T, std::size_t N>
void read(const Json& json, std::array<T, N>& out, const std::string& path) {
  if (!json.is_array() || json.size() != N) fail_at(path, fmt::format("must be a list of {}", N), json);
  for (std::size_t i = 0; i < N; ++i) read(json[i], out[i], fmt::format("{}[{}]", path, i));
}

template <class T>
void read(const Json& json, std::vector<T>& out, const std::string& path) {
  if (!json.is_array()) fail_at(path, "must be a list", json);
  if (json.size() > kMostItems) throw Error(fmt::format("{}: must have at most {} items", path, kMostItems));
  out.resize(json.size());
  for (std::size_t i = 0; i < out.size(); ++i) read(json[i], out[i], fmt::format("{}[{}]", path, i));
}

inline void read_request_number(const Json& json, std::optional<std::int64_t>& out) {
  if (const Json* value = member(json, "request", "message", false)) read(*value, out.emplace(), "message.request");
}

inline Json write(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
inline Json write(std::int64_t value) { return value; }
inline Json write(bool value) { return value; }
inline Json write(const std::string& value) { return value; }
inline Json write(const JsonText& value) { return Json::parse(value.text); }
inline Json write(const Value& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

template <class E>
std::string_view name_of(E value, std::initializer_list<std::string_view> names) {
  return names.begin()[static_cast<std::size_t>(value)];
}

template <class T, std::size_t N>
Json write(const std::array<T, N>& values);

template <class T>
Json write(const std::vector<T>& values) {
  Json out = Json::array();
  for (const T& value : values) out.push_back(write(value));
  return out;
}

template <class T, std::size_t N>
Json write(const std::array<T, N>& values) {
  Json out = Json::array();
  for (const T& value : values) out.push_back(write(value));
  return out;
}

}  // namespace espalier::api
