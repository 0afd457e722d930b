#include "run/input_files.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "io/file.h"
#include "model/texture_table.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostMeshBytes = 512ull << 20;

// How many folders above its own a relative path climbs.
int climbs(const std::string& path) {
  int count = 0;
  for (const fs::path& part : fs::path(path).lexically_normal()) count += part == "..";
  return count;
}

/// Paths of the mesh and image files that a grammar names, as written.
std::vector<std::string> files_named(const GeneratorGraph& graph) {
  std::vector<std::string> paths;
  for (const MeshRef& mesh : graph.meshes)
    if (mesh.kind == MeshKind::file) paths.push_back(mesh.path);
  for (const TextureRef& texture : image_textures(graph)) paths.push_back(texture.path);
  return paths;
}

}  // namespace

std::string InputFiles::add(const std::string& name, std::string bytes) {
  const std::string hash = content_hash(bytes);
  std::string free_name = name;
  for (int n = 2;; ++n) {
    const auto taken =
        std::find_if(files_.begin(), files_.end(), [&](const InputFile& f) { return f.name == free_name; });
    if (taken == files_.end()) break;
    if (taken->hash == hash) return free_name;
    const fs::path path(name);
    const std::string file = fmt::format("{}-{}{}", path.stem().string(), n, path.extension().string());
    free_name = (path.parent_path() / file).string();
  }
  files_.push_back({free_name, std::move(bytes), hash});
  return free_name;
}

void InputFiles::add_grammar(const LoadedGrammar& grammar) {
  int most_climbs = 0;
  const std::vector<std::string> named = files_named(*grammar.graph);
  for (const std::string& file : named) {
    if (fs::path(file).is_absolute()) {
      throw Error(fmt::format("{}: paths of meshes and images must be relative to the grammar's folder, got \"{}\"",
                              grammar.path, file));
    }
    most_climbs = std::max(most_climbs, climbs(file));
  }
  // The grammar keeps as many of its own folders as its files climb, so that "../meshes/x.obj" still leads there.
  const fs::path path = fs::absolute(grammar.path).lexically_normal();
  fs::path root = path.parent_path();
  for (int i = 0; i < most_climbs; ++i) root = root.parent_path();
  const auto name_for = [&](const fs::path& file) {
    return (fs::path("inputs") / file.lexically_normal().lexically_relative(root)).generic_string();
  };
  for (const SourceText& source : grammar.sources) {
    const std::string name = add(name_for(fs::absolute(source.name)), source.text);
    if (grammar_name_.empty()) grammar_name_ = name;
  }
  for (const std::string& one : named) {
    const fs::path file = path.parent_path() / one;
    add(name_for(file), read_file(file.string(), kMostMeshBytes));
  }
}

std::string InputFiles::add_target(const std::string& path) {
  const fs::path name = fs::path("inputs/targets") / fs::path(path).filename();
  return add(name.generic_string(), read_file(path, kMostMeshBytes));
}

const InputFile& InputFiles::add_start(const std::string& path) {
  const fs::path name = fs::path("inputs/start") / fs::path(path).filename();
  const std::string taken = add(name.generic_string(), read_file(path, kMostMeshBytes));
  return *std::find_if(files_.begin(), files_.end(), [&](const InputFile& file) { return file.name == taken; });
}

std::map<std::string, std::string> InputFiles::hashes() const {
  std::map<std::string, std::string> result;
  for (const InputFile& file : files_) result[file.name] = file.hash;
  return result;
}

void InputFiles::write(const std::string& folder) const {
  for (const InputFile& file : files_) {
    const fs::path path = fs::path(folder) / file.name;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) throw Error(fmt::format("{}: cannot make the folder: {}", path.parent_path().string(), error.message()));
    write_file(path.string(), file.bytes);
  }
}

}  // namespace espalier
