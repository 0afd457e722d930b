#include "run/checkpoint_changes.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/printable.h"
#include "base/version.h"
#include "io/file.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

/// "engine.ga.population" -> "24", for every line of a scene as to_toml writes it; tables of a list by their number.
std::map<std::string, std::string> by_key(const std::string& toml) {
  std::map<std::string, std::string> result;
  std::map<std::string, int> lists;
  std::string table;
  std::istringstream in(toml);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("[[")) {
      const std::string name = line.substr(2, line.find(']') - 2);
      table = fmt::format("{}.{}.", name, lists[name]++);
    } else if (line.starts_with('[')) {
      table = line.substr(1, line.find(']') - 1) + ".";
    } else if (const std::size_t equals = line.find(" = "); equals != std::string::npos) {
      result[table + line.substr(0, equals)] = line.substr(equals + 3);
    }
  }
  return result;
}

Scene without_what_may_differ(Scene scene) {
  scene.budget = {};
  scene.output.picture = {};
  scene.output.azimuth_deg = scene.output.elevation_deg = 0;
  return scene;
}

}  // namespace

Scene scene_of(const Checkpoint& checkpoint, const std::string& file) {
  return parse_scene(checkpoint.settings, file + ": its settings", "");
}

std::vector<std::string> input_changes(const std::map<std::string, std::string>& now,
                                       const std::map<std::string, std::string>& before) {
  std::vector<std::string> changes;
  for (const auto& [name, hash] : before) {
    const auto is = now.find(name);
    if (is == now.end()) changes.push_back(printable(name) + " is missing");
    else if (is->second != hash) changes.push_back(printable(name) + " is not what it was");
  }
  for (const auto& [name, hash] : now) {
    if (!before.contains(name)) changes.push_back(printable(name) + " was no part of it");
  }
  return changes;
}

std::vector<std::string> setting_changes(const Scene& now, const Scene& before) {
  const auto is = by_key(to_toml(without_what_may_differ(now))), was = by_key(to_toml(without_what_may_differ(before)));
  std::vector<std::string> changes;
  for (const auto& [key, value] : is) {
    const auto old = was.find(key);
    if (old == was.end()) changes.push_back(fmt::format("{} is {}, was not given", key, value));
    else if (old->second != value) changes.push_back(fmt::format("{} is {}, was {}", key, value, old->second));
  }
  for (const auto& [key, value] : was) {
    if (!is.contains(key)) changes.push_back(fmt::format("{} is not given, was {}", key, value));
  }
  return changes;
}

std::vector<std::string> folder_changes(const std::string& folder, const Scene& now, const Checkpoint& checkpoint) {
  std::vector<std::string> changes;
  if (checkpoint.version != kVersion) {
    changes.push_back(fmt::format("this is version {} of Espalier, the checkpoint was written by {}", kVersion,
                                  printable(checkpoint.version)));
  }
  std::map<std::string, std::string> now_there;
  for (const auto& [name, hash] : checkpoint.inputs) {
    const std::string path = (std::filesystem::path(folder) / name).string();
    if (std::filesystem::exists(path)) now_there[name] = content_hash(read_file(path));
  }
  for (std::string& change : input_changes(now_there, checkpoint.inputs)) changes.push_back(std::move(change));
  const Scene before = scene_of(checkpoint, (std::filesystem::path(folder) / kCheckpointName).string());
  for (std::string& change : setting_changes(now, before)) changes.push_back("run.toml: " + change);
  return changes;
}

}  // namespace espalier
