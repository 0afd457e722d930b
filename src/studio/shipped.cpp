#include "studio/shipped.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "io/file.h"
#include "io/image_import.h"
#include "io/mesh_import.h"
#include "run/temporary_folder.h"
#include "studio/grammar_check.h"
#include "studio/scene_json.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kGrammars = "grammars/", kScenes = "scenes/";
constexpr std::string_view kMeshEndings[] = {".obj", ".glb", ".gltf", ".ply", ".stl", ".off", ".dae", ".fbx", ".3ds"};
constexpr std::string_view kImageEndings[] = {".png", ".jpg", ".jpeg", ".pfm"};

constexpr const char* kEmptyGrammar = R"(grammar sketch 1
# A stem that bends and forks.
attr forks in 1..12 by 1 = 6 "Plant/Forks at most"
material wood = surface("#8a6a4f", roughness: 0.9)
start Plant

rule Plant { spawn Stem }

rule Stem when depth(Stem) < forks {
  spin ~ angle()
  bend ~ uniform(0deg, 40deg)
  turn y spin  turn x bend  scale 0.85
  bone (0, 0, 0) -> (0, 1, 0)
  { move y 0.5  size (0.16, 1, 0.16)  paint wood  emit cylinder(sides: 12) }
  move y 1
  spawn Stem
  maybe 0.5 spawn Stem
}
)";

/// Curves are followed by the guided engine; models it grows may be large.
constexpr const char* kGuidedScene = R"({"seed":1,"search":{"engine":"guided"},"limits":{"genes":{"min":1,"max":2000}}})";
constexpr const char* kPlainScene =
    R"({"seed":1,"search":{"engine":"ga"},"engine":{"ga":{"preset":"ga-local"}},"limits":{"genes":{"min":1,"max":400}}})";

std::string stem_of(std::string_view path) { return fs::path(path).stem().string(); }

/// "guided-tree" -> "Guided tree".
std::string title_of(std::string_view name) {
  std::string title(name);
  std::replace(title.begin(), title.end(), '-', ' ');
  if (!title.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

bool has_ending(std::string path, std::span<const std::string_view> endings) {
  for (char& c : path) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return path.ends_with(ending); });
}

bool draws_bones(std::string_view grammar) { return grammar.find("bone ") != std::string_view::npos; }

std::vector<api::Sample> make_samples() {
  std::vector<api::Sample> samples;
  for (const std::string_view folder : {kScenes, kGrammars}) {
    for (const ShippedFile& file : shipped_files()) {
      if (!file.path.starts_with(folder) || fs::path(file.path).parent_path() != folder.substr(0, folder.size() - 1)) continue;
      if (folder == kGrammars && file.bytes.find("\nstart ") == std::string_view::npos) continue;  // it is imported only
      const std::string name = stem_of(file.path);
      const auto same = [&](const api::Sample& sample) { return sample.name == name; };
      if (std::any_of(samples.begin(), samples.end(), same)) continue;
      samples.push_back({name, title_of(name), first_sentence(file.bytes), {}});
    }
  }
  return samples;
}

}  // namespace

std::optional<std::string_view> find_shipped(std::string_view path) {
  for (const ShippedFile& file : shipped_files()) {
    if (file.path == path) return file.bytes;
  }
  return std::nullopt;
}

const std::vector<api::Sample>& samples() {
  static const std::vector<api::Sample> all = make_samples();
  return all;
}

NewProject make_sample(const std::string& name) {
  NewProject project;
  const auto scene = find_shipped(fmt::format("{}{}.toml", kScenes, name));
  if (!scene) {
    const auto grammar = find_shipped(fmt::format("{}{}.esp", kGrammars, name));
    if (!grammar) throw Error(fmt::format("there is no sample {}", name.substr(0, 80)));
    project.state.grammar = *grammar;
    project.state.scene = draws_bones(*grammar) ? kGuidedScene : kPlainScene;
    return project;
  }
  const fs::path folder(kScenes);
  const auto resolved = [&](const std::string& path) { return (folder / path).lexically_normal().generic_string(); };
  const auto grammar = find_shipped(resolved(grammar_of(*scene, name)));
  if (!grammar) throw Error(fmt::format("the sample {} has no grammar", name));
  project.state.grammar = *grammar;
  const std::string json = scene_json(*scene, name);
  std::map<std::string, std::string> names;
  for (const std::string& file : files_of(json)) {
    const auto bytes = find_shipped(resolved(file));
    if (!bytes) throw Error(fmt::format("the sample {} lacks {}", name, file));
    const std::string path = fs::path(file).filename().string();
    if (!names.insert({file, path}).second) continue;
    project.state.files.push_back(describe_file(path, std::string(*bytes)));
    project.blobs[project.state.files.back().hash] = *bytes;
  }
  sort_by_path(project.state.files);
  project.state.scene = with_files(json, names);
  return project;
}

NewProject make_empty_project() { return {{kEmptyGrammar, kGuidedScene, {}}, {}}; }

StoredFile describe_file(const std::string& path, const std::string& bytes) {
  StoredFile file{path, content_hash(bytes), bytes.size()};
  const bool mesh = has_ending(path, kMeshEndings), image = has_ending(path, kImageEndings);
  if (!mesh && !image && !path.ends_with(".esp")) {
    throw Error(fmt::format("{}: must be a mesh (.obj, .glb, .ply, .stl ..), an image (.png, .jpg, .pfm) or a grammar (.esp)",
                            path));
  }
  if (!mesh && (!image || path.ends_with(".pfm"))) return file;
  const TemporaryFolder folder;
  const std::string name = fs::path(path).filename().string();
  write_file(folder.file(name), bytes);
  try {
    if (image) {
      FileImageSource().load(folder.file(name));
      return file;
    }
    const Mesh loaded = AssimpMeshSource({Store::kMostFileBytes, 5'000'000}).load(folder.file(name));
    file.triangles = loaded.triangles.size();
    const Vec3 size = bounds(loaded).size();
    file.size = {size.x, size.y, size.z};
  } catch (const Error& error) {
    std::string message = error.what();
    for (std::size_t at; (at = message.find(folder.file(""))) != std::string::npos;) message.erase(at, folder.file("").size());
    throw Error(message);
  }
  return file;
}

}  // namespace espalier::studio
