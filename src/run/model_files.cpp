#include "run/model_files.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/check.h"
#include "base/version.h"
#include "derivation/encode.h"
#include "io/export.h"
#include "io/file.h"
#include "io/image.h"
#include "run/mesh_look.h"

namespace espalier {

std::string hash_text(const Derivation& derivation) { return fmt::format("{:016x}", hash(derivation)); }

std::string derivation_document(const GeneratorGraph& graph, const Derivation& derivation,
                                const Provenance& provenance) {
  std::string text = encode(graph, derivation);
  CHECK(text.ends_with('}'));
  text.pop_back();
  return text + ",\n \"provenance\": " + to_json(provenance) + "}\n";
}

Provenance provenance_in_folder(const std::string& made_by, std::uint64_t seed, std::uint64_t index,
                                const InputFiles& inputs, const std::string& settings, const Derivation& derivation) {
  Provenance p;
  p.version = kVersion;
  p.made_by = made_by;
  p.seed = seed;
  p.index = index;
  p.inputs = inputs.hashes();
  p.settings = settings;
  p.settings_folder = ".";
  p.derivation = hash_text(derivation);
  return p;
}

ModelFiles::ModelFiles(const GeneratorGraph& graph, const MeshTable& meshes, const TextureTable& textures,
                       const std::vector<Mesh>& ghosts, const RenderSettings& look, Executor& executor)
    : graph_(graph),
      meshes_(meshes),
      textures_(textures),
      ghosts_(ghosts),
      look_(look),
      executor_(executor),
      expander_(graph) {}

std::uint64_t ModelFiles::write(const Derivation& derivation, const std::string& path, const Provenance& provenance) {
  if (path.ends_with(".json")) {
    write_file(path, derivation_document(graph_, derivation, provenance));
    return 0;
  }
  if (path.ends_with(".png")) {
    const Picture drawn = picture(derivation);
    write_png(path, drawn.width, drawn.height, drawn.rgb, provenance);
    return 0;
  }
  expander_.expand(derivation, ExpandTo::full, model_);
  return export_as(path, provenance);
}

std::vector<ModelFiles::LevelFile> ModelFiles::write_levels(const Derivation& derivation, const std::string& path,
                                                            LevelOfDetail detail, Provenance provenance) {
  const std::filesystem::path out(path);
  expander_.expand(derivation, ExpandTo::full, model_);
  std::vector<LevelFile> files;
  for (detail.level = 0; detail.level < LevelOfDetail::kCount; ++detail.level) {
    const std::string name = fmt::format("{}-lod{}{}", out.stem().string(), detail.level, out.extension().string());
    provenance.mesh = to_toml(detail);
    files.push_back({name, export_as((out.parent_path() / name).string(), provenance)});
  }
  return files;
}

std::uint64_t ModelFiles::export_as(const std::string& path, const Provenance& provenance) {
  ExportOptions options;
  if (!provenance.mesh.empty()) options.detail = parse_level_of_detail(provenance.mesh, "the model's settings");
  return export_model(path, model_, meshes_, Surfaces(graph_, model_, textures_), provenance, options);
}

const Model& ModelFiles::model_of(const Derivation& derivation) {
  expander_.expand(derivation, ExpandTo::full, model_);
  return model_;
}

Picture ModelFiles::picture(const Derivation& derivation) { return picture(derivation, {look_.width, look_.height}); }

Picture ModelFiles::picture(const Derivation& derivation, std::array<std::uint32_t, 2> size) {
  expander_.expand(derivation, ExpandTo::full, model_);
  RenderSettings settings = look_;
  settings.width = size[0], settings.height = size[1];
  return render(model_, meshes_, Surfaces(graph_, model_, textures_), ghosts_, settings, executor_);
}

}  // namespace espalier
