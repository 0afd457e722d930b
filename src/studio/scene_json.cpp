#include "studio/scene_json.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/scene_toml.h"
#include "run/toml_value.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kName = "scene";
constexpr double kSeconds = 2;  // of scenes without a budget

Json parse(std::string_view json) {
  Json scene = Json::parse(json, nullptr, false);
  if (!scene.is_object()) throw Error("the scene must be an object");
  return scene;
}

std::string key_of(const std::string& key) {
  constexpr const char* kBare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !key.empty() && key.find_first_not_of(kBare) == std::string::npos ? key : quote_toml(key);
}

std::string inline_toml(const Json& value) {
  switch (value.type()) {
    case Json::value_t::boolean: return value.get<bool>() ? "true" : "false";
    case Json::value_t::number_integer: return fmt::format("{}", value.get<std::int64_t>());
    case Json::value_t::number_unsigned: return fmt::format("{}", value.get<std::uint64_t>() >> 63 ? INT64_MAX : value.get<std::int64_t>());
    case Json::value_t::number_float: return format_toml(value.get<double>());
    case Json::value_t::string: return quote_toml(value.get<std::string>());
    case Json::value_t::array: {
      std::string text;
      for (const Json& item : value) text += (text.empty() ? "" : ", ") + inline_toml(item);
      return "[" + text + "]";
    }
    case Json::value_t::object: {
      std::string text;
      for (const auto& [key, item] : value.items()) {
        if (!item.is_null()) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key_of(key), inline_toml(item));
      }
      return "{" + text + "}";
    }
    default: return "\"null\"";  // within lists; the reader says what it wants instead
  }
}

/// `json` without what only its own lists would say: no curves, no meshes, no images.
bool drop_empty_targets(Json& scene) {
  const auto empty = [&](const char* table, const char* list) {
    const auto it = scene.find(table);
    if (it == scene.end()) return true;
    if (!it->is_object()) return false;
    const auto items = it->find(list);
    if (items != it->end() && !(items->is_array() && items->empty())) return false;
    scene.erase(it);
    return true;
  };
  const bool curves = !empty("curves", "curve"), volume = !empty("volume", "mesh");
  const auto silhouettes = scene.find("silhouette");
  const bool none = silhouettes == scene.end() || (silhouettes->is_array() && silhouettes->empty());
  if (none && silhouettes != scene.end()) scene.erase(silhouettes);
  return curves || volume || !none;
}

/// Calls visit(value, place) for every text that names a file.
void visit_files(Json& scene, const std::function<void(Json&, const std::string&)>& visit) {
  const auto in = [&](Json& holder, const std::string& place, std::initializer_list<const char*> keys) {
    if (!holder.is_object()) return;
    for (const char* key : keys) {
      const auto it = holder.find(key);
      if (it != holder.end() && it->is_string()) visit(*it, place + "." + key);
    }
  };
  if (scene.contains("volume") && scene["volume"].is_object() && scene["volume"].contains("mesh")) {
    std::size_t i = 0;
    for (Json& mesh : scene["volume"]["mesh"]) in(mesh, fmt::format("volume.mesh.{}", i++), {"file"});
  }
  if (scene.contains("silhouette")) {
    std::size_t i = 0;
    for (Json& one : scene["silhouette"]) in(one, fmt::format("silhouette.{}", i++), {"image", "want_image", "avoid_image"});
  }
}

/// "scene:12:3: curves.x must be .." without the place, which nobody sees.
std::string without_place(std::string message) {
  for (std::size_t at = 0; (at = message.find(std::string(kName) + ":", at)) != std::string::npos;) {
    std::size_t end = at + std::char_traits<char>::length(kName) + 1;
    end = message.find_first_not_of("0123456789:", end);
    if (end == std::string::npos) break;
    message.erase(at, message.find_first_not_of(' ', end) - at);
  }
  return message;
}

Json attributes_json(const Json& scene, const std::map<std::string, Kind>& known) {
  Json result = Json::object();
  const auto attributes = scene.find("attributes");
  if (attributes == scene.end() || !attributes->is_object()) return result;
  for (const auto& [name, value] : attributes->items()) {
    const auto it = known.find(name);
    if (it == known.end() || value.is_null()) continue;
    const bool angle = it->second == Kind::angle && value.is_number();
    result[name] = angle ? Json(fmt::format("{}deg", value.get<double>())) : value;
  }
  return result;
}

Json json_of(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::boolean: return value.boolean;
    case TomlValue::Kind::integer: return value.integer;
    case TomlValue::Kind::real: return value.real;
    case TomlValue::Kind::text: return value.text;
    case TomlValue::Kind::array: {
      Json list = Json::array();
      for (const TomlValue& item : value.items) list.push_back(json_of(item));
      return list;
    }
    case TomlValue::Kind::table: {
      Json table = Json::object();
      for (const auto& [key, member] : value.members) table[key] = json_of(member);
      return table;
    }
    default: return nullptr;
  }
}

}  // namespace

ReadScene read_scene(std::string_view json, const SceneSurroundings& surroundings) {
  Json scene = parse(json);
  ReadScene result;
  result.locks = locks_of(json);
  const Json attributes = attributes_json(scene, surroundings.attributes);
  for (const char* key : {"espalier", "grammar", "start", "threads", "attributes"}) scene.erase(key);
  visit_files(scene, [](Json& file, const std::string& place) {
    const std::string path = file.get<std::string>();
    if (!is_plain_path(path)) throw Error(fmt::format("{} must be a file of the project, got {}", place, quote_toml(path)));
  });
  result.has_targets = drop_empty_targets(scene);
  if (!result.has_targets) scene["curves"]["curve"] = {{{"points", {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}}}}};
  if (!attributes.empty()) scene["attributes"] = attributes;
  if (!scene.contains("budget")) scene["budget"]["seconds"] = kSeconds;
  std::string toml = fmt::format("espalier = 1\ngrammar = {}\n", quote_toml(surroundings.grammar));
  for (const auto& [key, value] : scene.items()) {
    if (!value.is_null()) toml += fmt::format("{} = {}\n", key_of(key), inline_toml(value));
  }
  try {
    result.scene = parse_scene(toml, kName, surroundings.folder);
  } catch (const Error& error) {
    throw Error(without_place(error.what()));
  }
  if (!result.has_targets) result.scene.curves = {};
  return result;
}

std::map<std::string, std::string> attributes_of(std::string_view json, const std::map<std::string, Kind>& known) {
  std::map<std::string, std::string> result;
  const Json attributes = attributes_json(parse(json), known);
  for (const auto& [name, value] : attributes.items()) {
    if (value.is_string()) result[name] = value.get<std::string>();
    if (value.is_boolean()) result[name] = value.get<bool>() ? "true" : "false";
    if (value.is_number()) result[name] = fmt::format("{}", value.get<double>());
  }
  return result;
}

std::string scene_json(std::string_view toml, const std::string& name) {
  Json scene = json_of(parse_toml(toml, name));
  for (const char* key : {"espalier", "grammar", "start", "threads"}) scene.erase(key);
  return scene.dump();
}

std::string grammar_of(std::string_view toml, const std::string& name) {
  const TomlValue root = parse_toml(toml, name);
  const TomlValue* const grammar = root.find("grammar");
  if (!grammar || grammar->kind != TomlValue::Kind::text) throw Error(fmt::format("{}: grammar must be the path of one", name));
  return grammar->text;
}

std::vector<std::string> files_of(std::string_view json) {
  Json scene = parse(json);
  std::vector<std::string> files;
  visit_files(scene, [&](Json& file, const std::string&) { files.push_back(file.get<std::string>()); });
  return files;
}

std::string with_files(std::string_view json, const std::map<std::string, std::string>& names) {
  Json scene = parse(json);
  visit_files(scene, [&](Json& file, const std::string&) {
    const auto found = names.find(file.get<std::string>());
    if (found != names.end()) file = found->second;
  });
  return scene.dump();
}

std::string with_locks(std::string_view json, const std::vector<std::string>& locks) {
  Json scene = parse(json);
  if (!locks.empty()) {
    if (!scene["start"].is_object()) scene["start"] = Json::object();
    scene["start"]["locks"] = locks;
  } else {
    scene.erase("start");
  }
  return scene.dump();
}

std::vector<std::string> locks_of(std::string_view json) {
  std::vector<std::string> locks;
  const Json scene = parse(json);
  const auto start = scene.find("start");
  if (start == scene.end() || !start->is_object()) return locks;
  const auto list = start->find("locks");
  if (list == start->end() || !list->is_array()) return locks;
  for (const Json& lock : *list) {
    if (lock.is_string() && locks.size() < 10'000) locks.push_back(lock.get<std::string>());
  }
  return locks;
}

}  // namespace espalier::studio
