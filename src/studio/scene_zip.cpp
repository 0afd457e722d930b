#include "studio/scene_zip.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/printable.h"
#include "io/provenance.h"
#include "studio/scene_project.h"
#include "studio/zip_reader.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = "scene.toml";
constexpr const char* kDerivation = "best.derivation.json";
constexpr const char* kLeftovers = "__MACOSX/";  // what some systems put beside the files
constexpr std::size_t kMostModelBytes = 16u << 20, kMostName = 100;

using ZipFiles = std::map<std::string, std::string>;

/// The path of the file of that name which lies highest; "" where there is none.
std::string highest(const ZipFiles& files, const std::string& name) {
  std::string found;
  const auto depth = [](const std::string& path) { return std::count(path.begin(), path.end(), '/'); };
  for (const auto& [path, bytes] : files) {
    if (path.starts_with(kLeftovers) || fs::path(path).filename() != name) continue;
    if (found.empty() || depth(path) < depth(found)) found = path;
  }
  return found;
}

/// The scene that a derivation was made with, as its provenance has it.
std::string settings_of(const std::string& derivation, const std::string& path) {
  if (derivation.size() > kMostModelBytes) {
    throw Error(fmt::format("{}: must have at most {} bytes", path, kMostModelBytes));
  }
  const auto flat = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) { return depth < 8; };
  const nlohmann::json json = nlohmann::json::parse(derivation, flat, false);
  if (!json.is_object() || !json.contains("provenance")) {
    throw Error(fmt::format("{} does not say which grammar it belongs to", path));
  }
  return parse_provenance(json["provenance"].dump()).settings;
}

}  // namespace

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

WholeProject project_of_zip(std::string_view archive) {
  ZipFiles files = read_zip(archive);
  std::string scene = highest(files, kScene);
  if (scene.empty()) {
    const std::string model = highest(files, kDerivation);
    if (model.empty()) throw Error(fmt::format("the zip file has no {}: it is no scene folder of the studio", kScene));
    scene = (fs::path(model).parent_path() / kScene).generic_string();
    files[scene] = settings_of(files[model], model);
  }
  const auto read = [&](const std::string& path) {
    const auto found = files.find(path);
    if (found == files.end()) throw Error(fmt::format("the zip file has no {}", path));
    return found->second;
  };
  WholeProject project;
  project.content = project_of_scene(scene, read);
  const fs::path folder = fs::path(scene).parent_path();
  project.name = folder.empty() ? "Scene" : printable(folder.filename().string()).substr(0, kMostName);
  const auto model = files.find((folder / kDerivation).generic_string());
  if (model != files.end() && model->second.size() <= kMostModelBytes) project.shown = model->second;
  return project;
}

}  // namespace espalier::studio
