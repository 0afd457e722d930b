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
#include "studio/file_kind.h"
#include "studio/grammar_check.h"
#include "studio/scene_project.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

// Samples are scenes, else grammars; some of these have settings of their own.
constexpr std::string_view kGrammars = "grammars/", kScenes = "scenes/", kSettings = "scenes/samples/";
const std::string kPictures = "scenes/pictures/";
std::string stem_of(std::string_view path) { return fs::path(path).stem().string(); }

/// "guided-tree" -> "Guided tree".
std::string title_of(std::string_view name) {
  std::string title(name);
  std::replace(title.begin(), title.end(), '-', ' ');
  if (!title.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

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
      if (const std::string picture = name + ".webp"; find_shipped(kPictures + picture)) samples.back().picture = "samples/" + picture;
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

std::optional<std::string_view> sample_picture(const std::string& name) { return find_shipped(kPictures + name); }

NewProject make_sample(const std::string& name) {
  const ReadPath read = [&](const std::string& path) {
    const auto bytes = find_shipped(path);
    if (!bytes) throw Error(fmt::format("the sample {} lacks {}", name, path));
    return std::string(*bytes);
  };
  const std::string grammar = fmt::format("{}{}.esp", kGrammars, name);
  for (const std::string_view folder : {kScenes, kSettings}) {
    const std::string scene = fmt::format("{}{}.toml", folder, name);
    if (find_shipped(scene)) return project_of_scene(scene, read);
  }
  if (find_shipped(grammar)) return project_of_grammar(grammar, read);
  throw Error(fmt::format("there is no sample {}", name.substr(0, 80)));
}

StoredFile describe_file(const std::string& path, const std::string& bytes) {
  StoredFile file{path, content_hash(bytes), bytes.size()};
  const bool mesh = file_kind(path) == FileKind::mesh, image = file_kind(path) == FileKind::image;
  if (file_kind(path) == FileKind::other) {
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
    const Mesh loaded = AssimpMeshSource({Store::kMostFileBytes, kMostFileTriangles}).load(folder.file(name));
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
