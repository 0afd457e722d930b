// States of a project: texts and files, each kept once by its content.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/hash.h"
#include "studio/store.h"

namespace espalier::studio {

void sort_by_path(std::vector<StoredFile>& files) {
  std::sort(files.begin(), files.end(), [](const StoredFile& a, const StoredFile& b) { return a.path < b.path; });
}

std::string to_json(const std::vector<StoredFile>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const StoredFile& file : files) {
    list.push_back({{"path", file.path}, {"hash", file.hash}, {"bytes", file.bytes}, {"triangles", file.triangles},
                    {"size", file.size}});
  }
  return list.dump();
}

std::vector<StoredFile> parse_files(std::string_view json) {
  std::vector<StoredFile> files;
  try {
    for (const nlohmann::json& item : nlohmann::json::parse(json)) {
      files.push_back({item.at("path"), item.at("hash"), item.at("bytes"), item.at("triangles"), item.at("size")});
    }
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("the list of a project's files is damaged: {}", error.what()));
  }
  return files;
}

Store::Head Store::head(std::int64_t project) {
  Statement ask = database_->prepare("select number, grammar, scene, files, gesture from step "
                                     "join project on id = project and number = head where id = ?");
  if (!ask.bind(project).step()) fail_no_project(project);
  return {ask.whole(0), ask.text(1), ask.text(2), ask.text(3), ask.text(4)};
}

std::string Store::text(std::int64_t project, const std::string& hash) {
  Statement ask = database_->prepare("select bytes from text where project = ? and hash = ?");
  if (!ask.bind(project).bind(hash).step()) throw Error(fmt::format("project {} is damaged: a text is missing", project));
  return ask.text(0);
}

std::string Store::keep_text(std::int64_t project, const std::string& text) {
  const std::string hash = content_hash(text);
  database_->prepare("insert or ignore into text values (?, ?, ?)").bind(project).bind(hash).bind_blob(text).run();
  return hash;
}

std::string Store::keep_files(std::int64_t project, const std::vector<StoredFile>& files,
                              const std::map<std::string, std::string>& blobs) {
  if (files.size() > kMostFiles) throw Error(fmt::format("a project has at most {} files", kMostFiles));
  for (const auto& [hash, bytes] : blobs) {
    if (bytes.size() > kMostFileBytes) throw Error(fmt::format("a file has at most {} bytes", kMostFileBytes));
    database_->prepare("insert or ignore into blob values (?, ?, ?)").bind(project).bind(hash).bind_blob(bytes).run();
  }
  for (const StoredFile& file : files) {
    Statement ask = database_->prepare("select 1 from blob where project = ? and hash = ?");
    if (!ask.bind(project).bind(file.hash).step()) throw Error(fmt::format("{}: its bytes are missing", file.path));
  }
  if (!blobs.empty()) {
    Statement ask = database_->prepare("select sum(length(bytes)) from blob where project = ?");
    if (ask.bind(project).step() && static_cast<std::uint64_t>(ask.whole(0)) > kMostProjectBytes) {
      throw Error(fmt::format("the files of a project, those that undo brings back among them, have at most {} bytes",
                              kMostProjectBytes));
    }
  }
  return keep_text(project, to_json(files));
}

StoredProjectState Store::read(std::int64_t project) {
  const Head at = head(project);
  StoredProjectState result;
  Statement ask = database_->prepare("select name, changed, revision from project where id = ?");
  ask.bind(project).step();
  result.project = {project, ask.text(0), ask.number(1)};
  result.revision = ask.whole(2);
  result.state = {text(project, at.grammar), text(project, at.scene), parse_files(text(project, at.files))};
  Statement steps = database_->prepare("select number, label from step where project = ? and number between ? and ?");
  steps.bind(project).bind(at.number - 1).bind(at.number + 1);
  std::optional<std::string> own;
  while (steps.step()) {
    if (steps.whole(0) == at.number) own = steps.text(1);
    if (steps.whole(0) == at.number - 1) result.undo = "";
    if (steps.whole(0) == at.number + 1) result.redo = steps.text(1);
  }
  if (result.undo) result.undo = own;
  return result;
}

std::string Store::blob(std::int64_t project, const std::string& hash) {
  const std::lock_guard lock(mutex_);
  Statement ask = database_->prepare("select bytes from blob where project = ? and hash = ?");
  if (!ask.bind(project).bind(hash).step()) throw Error("there is no such file");
  return ask.text(0);
}

}  // namespace espalier::studio
