#include "studio/project_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/error.h"
#include "studio/breeding_file.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostGrammarBytes = 1'000'000, kMostSceneBytes = 1'000'000, kMostModelBytes = 16u << 20;
constexpr std::size_t kMostPictureText = Store::kMostPictureBytes * 4 / 3 + 4;
constexpr int kMostDepth = 80;

std::string text_of(const Json& json, const char* key, std::size_t most) {
  const auto it = json.find(key);
  if (it == json.end() || !it->is_string()) throw Error(fmt::format("the project file must have {}, a text", key));
  std::string text = it->get<std::string>();
  if (text.size() > most) throw Error(fmt::format("the project file's {} must have at most {} bytes", key, most));
  return text;
}

const Json& list_of(const Json& json, const char* key, std::size_t most) {
  const auto it = json.find(key);
  if (it == json.end() || !it->is_array()) throw Error(fmt::format("the project file must have {}, a list", key));
  if (it->size() > most) throw Error(fmt::format("the project file's {} must be at most {}", key, most));
  return *it;
}

void read_files(const Json& list, NewProject& content) {
  for (const Json& item : list) {
    if (!item.is_object()) throw Error("the project file's files must be objects");
    const std::string path = text_of(item, "path", 200);
    if (!is_plain_path(path)) throw Error(fmt::format("the project file names a file \"{}\", which leads elsewhere", path));
    const std::string bytes = decode_base64(text_of(item, "bytes", kMostProjectFileBytes));
    StoredFile file = describe_file(path, bytes);
    content.blobs[file.hash] = bytes;
    content.state.files.push_back(std::move(file));
  }
  std::vector<StoredFile>& files = content.state.files;
  sort_by_path(files);
  const auto twice = std::adjacent_find(files.begin(), files.end(),
                                        [](const StoredFile& a, const StoredFile& b) { return a.path == b.path; });
  if (twice != files.end()) throw Error(fmt::format("the project file has {} twice", twice->path));
}

}  // namespace

std::string project_file(const WholeProject& project) {
  Json json = {{"espalier_project", kProjectFileVersion}, {"name", project.name},
               {"grammar", project.content.state.grammar}, {"scene", Json::parse(project.content.state.scene)},
               {"shown", project.shown}};
  json["files"] = Json::array();
  for (const StoredFile& file : project.content.state.files) {
    json["files"].push_back({{"path", file.path}, {"bytes", encode_base64(project.content.blobs.at(file.hash))}});
  }
  json["favourites"] = Json::array();
  for (const StoredFavourite& one : project.favourites) {
    json["favourites"].push_back({{"score", one.score}, {"genes", one.genes}, {"words", one.words},
                                  {"derivation", one.derivation}});
    if (!one.picture.empty()) json["favourites"].back()["picture"] = encode_base64(one.picture);
  }
  for (const WholeBreeding& one : project.breedings) json["breedings"].push_back(breeding_json(one));
  std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (text.size() > kMostProjectFileBytes) {
    throw Error(fmt::format("a project file has at most {} bytes, this one would have {}: export the breeding sessions by "
                            "themselves, and delete those that are not needed", kMostProjectFileBytes, text.size()));
  }
  return text;
}

WholeProject parse_project_file(std::string_view text) {
  if (text.size() > kMostProjectFileBytes) throw Error(fmt::format("a project file has at most {} bytes", kMostProjectFileBytes));
  const auto bounded = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kMostDepth) throw Error("the project file is nested too deep");
    return true;
  };
  const Json json = Json::parse(text, bounded, false);
  if (!json.is_object() || !json.contains("espalier_project")) throw Error("this is no project file");
  if (json["espalier_project"] != kProjectFileVersion) {
    throw Error(fmt::format("the project file must be of version {}, got {}", kProjectFileVersion,
                            json["espalier_project"].dump().substr(0, 40)));
  }
  WholeProject project;
  project.name = text_of(json, "name", 200);
  project.content.state.grammar = text_of(json, "grammar", kMostGrammarBytes);
  if (!json.contains("scene") || !json["scene"].is_object()) throw Error("the project file must have scene, an object");
  project.content.state.scene = json["scene"].dump();
  if (project.content.state.scene.size() > kMostSceneBytes) throw Error("the project file's scene is too large");
  project.shown = text_of(json, "shown", kMostModelBytes);
  read_files(list_of(json, "files", Store::kMostFiles), project.content);
  for (const Json& item : list_of(json, "favourites", Store::kMostFavourites)) {
    if (!item.is_object() || !item.contains("score") || !item["score"].is_number() || !item.contains("genes") ||
        !item["genes"].is_number_unsigned()) {
      throw Error("the project file's favourites must have score and genes, numbers");
    }
    project.favourites.push_back({0, item["score"], item["genes"].get<std::int64_t>(), text_of(item, "words", 10'000),
                                  text_of(item, "derivation", kMostModelBytes)});
    if (item.contains("picture")) project.favourites.back().picture = decode_base64(text_of(item, "picture", kMostPictureText));
  }
  if (json.contains("breedings")) {  // files of before the breeding room have none
    for (const Json& item : list_of(json, "breedings", BreedingStore::kMostBreedings)) project.breedings.push_back(parse_breeding(item));
  }
  return project;
}

}  // namespace espalier::studio
