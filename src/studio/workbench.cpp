#include "studio/workbench.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "io/file.h"
#include "model/primitives.h"
#include "studio/grammar_check.h"
#include "studio/shipped.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStart = "start.derivation.json";

/// A closed mesh within -0.5..0.5 as OBJ.
std::string obj_of(const Mesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const Triangle& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

void write(const std::string& path, std::string_view bytes) {
  fs::create_directories(fs::path(path).parent_path());
  write_file(path, bytes);
}

std::string_view shipped_grammar(const std::string& path) {
  const auto bytes = find_shipped("grammars/" + path);
  return bytes ? *bytes : std::string_view();
}

void require_plain(const std::string& path, const char* what) {
  if (!is_plain_path(path)) throw Error(fmt::format("{} \"{}\" must be a file of the project", what, path));
}

}  // namespace

ReadImport import_reader(const std::vector<StoredFile>& files, ReadBlob read_blob) {
  return [files, read_blob = std::move(read_blob)](const std::string& path) -> std::string {
    for (const StoredFile& file : files) {
      if (file.path == path) return read_blob(file.hash);
    }
    if (const std::string_view shipped = shipped_grammar(path); !shipped.empty()) return std::string(shipped);
    throw Error(fmt::format("{}: the project has no such file", path));
  };
}

/// Meshes of files below one folder, each read once as long as it stays as it is: reading takes a process.
class Workbench::Meshes final : public MeshSource {
 public:
  explicit Meshes(std::string folder) : root_(fs::canonical(folder)) {}

  Mesh load(const std::string& path) override {
    const fs::path file = fs::weakly_canonical(path);
    if (file.lexically_relative(root_).begin()->string() == "..") {
      throw Error(fmt::format("{}: must be a file of the project", fs::path(path).filename().string()));
    }
    const auto known = loaded_.find(file.string());
    if (known != loaded_.end()) return known->second;
    return loaded_.emplace(file.string(), source_.load(file.string())).first->second;
  }
  void forget() { loaded_.clear(); }

 private:
  fs::path root_;
  AssimpMeshSource source_{{Store::kMostFileBytes, 5'000'000}};
  std::map<std::string, Mesh> loaded_;
};

Workbench::Workbench(ReadBlob read_blob)
    : real_folder_((fs::canonical(folder_.file("")) / "").string()), read_blob_(std::move(read_blob)),
      meshes_(std::make_unique<Meshes>(folder_.file(""))) {
  write(folder_.file("shapes/box.obj"), obj_of(make_primitive(MeshKind::box, 1, 0)));
  write(folder_.file("shapes/sphere.obj"), obj_of(make_primitive(MeshKind::sphere, 1, 0)));
  write(folder_.file("shapes/cylinder.obj"), obj_of(make_primitive(MeshKind::cylinder, 1, 48)));
  for (const ShippedFile& file : shipped_files()) {
    if (file.path.starts_with("grammars/")) write(folder_.file(fs::path(file.path).filename().string()), file.bytes);
  }
}

Workbench::~Workbench() = default;

void Workbench::place_files(const StoredState& state) {
  std::map<std::string, std::string> wanted;
  for (const StoredFile& file : state.files) {
    require_plain(file.path, "the file");
    wanted[file.path] = file.hash;
  }
  if (wanted == placed_) return;
  meshes_->forget();
  for (auto it = placed_.begin(); it != placed_.end();) {
    if (const auto still = wanted.find(it->first); still != wanted.end() && still->second == it->second) {
      ++it;
      continue;
    }
    std::error_code ignored;
    fs::remove(folder_.file(it->first), ignored);
    if (const std::string_view shipped = shipped_grammar(it->first); !shipped.empty()) write(folder_.file(it->first), shipped);
    it = placed_.erase(it);
  }
  for (const auto& [path, hash] : wanted) {
    if (placed_.count(path) != 0) continue;
    write(folder_.file(path), read_blob_(hash));
    placed_[path] = hash;
  }
}

LoadedGrammar Workbench::compile(const StoredState& state) {
  // Attributes that the grammar does not have are left out of the scene, so it must be known which it has.
  if (state.grammar != compiled_text_ || placed_ != compiled_files_) {
    const CheckedText plain = check_text(state.grammar, {}, import_reader(state.files, read_blob_));
    if (!plain.compiled.checked) throw GrammarFault();
    kinds_ = attribute_kinds(*plain.compiled.checked);
    compiled_text_.clear();
  }
  write_file(folder_.file(kGrammarName), state.grammar);
  LoadedGrammar grammar = load_grammar(folder_.file(kGrammarName), attributes_of(state.scene, kinds_));
  for (const MeshRef& mesh : grammar.graph->meshes) {
    if (mesh.kind == MeshKind::file) require_plain(mesh.path, "the mesh");
  }
  for (const TextureRef& texture : image_textures(*grammar.graph)) require_plain(texture.path, "the image");
  return grammar;
}

void Workbench::take(const StoredState& state) {
  place_files(state);
  const bool same_text = state.grammar == compiled_text_ && placed_ == compiled_files_;
  if (!ready() || !same_text || attributes_of(state.scene, kinds_) != compiled_attributes_) {
    LoadedGrammar grammar = compile(state);
    grammar_ = std::move(grammar);
    ++grammar_number_;
    compiled_text_ = state.grammar;
    compiled_files_ = placed_;
    compiled_attributes_ = attributes_of(state.scene, kinds_);
  }
  scene_ = read_scene(state.scene, {kGrammarName, folder_.file(""), kinds_});
}

std::shared_ptr<const Setup> Workbench::set_up(const std::optional<StartModel>& start, std::optional<std::uint64_t> seed) {
  Scene scene = scene_.scene;
  if (seed) scene.seed = *seed;
  if (start) {
    write_file(folder_.file(kStart), start->derivation);
    scene.start.derivation = kStart;
    for (const std::string& lock : start->locks) scene.start.locks.push_back({lock, LockScope::subtree});
  }
  try {
    const bool staged = probed_ && probed_->grammar.graph == grammar_.graph;
    std::shared_ptr<Setup> setup = espalier::set_up(scene, grammar_, *meshes_, staged ? probed_.get() : nullptr);
    // Many setups are kept with the models that they showed; of the probes only the stage is of use here.
    if (setup->probes) probed_ = setup;
    setup->probes.reset();
    return setup;
  } catch (const Error& error) {
    throw Error(as_named(error.what()));
  }
}

std::string Workbench::as_named(std::string text) const {
  // Some of what reads files says where they really are.
  for (const std::string& folder : {real_folder_, folder_.file("")}) {
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
  }
  return text;
}

}  // namespace espalier::studio
