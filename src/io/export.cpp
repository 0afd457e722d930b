#include "io/export.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "base/error.h"
#include "io/file.h"
#include "io/writers.h"

namespace espalier {
namespace {

/// The grammar's name where the provenance tells it, else that of the file.
std::string model_name(const std::string& path, const Provenance& provenance) {
  for (const auto& [name, hash] : provenance.inputs) {
    if (name.ends_with(".esp")) return std::filesystem::path(name).stem().string();
  }
  return std::filesystem::path(path).stem().string();
}

}  // namespace

std::uint64_t export_model(const std::string& path, const Model& model, const MeshTable& meshes,
                           const Surfaces& surfaces, const Provenance& provenance, const ExportOptions& options) {
  const std::filesystem::path file(path);
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (ending != ".glb" && ending != ".obj" && ending != ".ply" && ending != ".stl") {
    throw Error(fmt::format("{}: models are written as .glb, .obj, .ply or .stl, got \"{}\"", path, ending));
  }
  const std::vector<Material>& materials = surfaces.materials();
  const Parts parts = options.detail ? parts_at(model, meshes, materials, *options.detail, options.full)
                                     : collect_parts(model, meshes, options.full, materials);
  const std::uint64_t triangles = triangle_count(parts);
  const WriterInput input{parts, surfaces, provenance, model_name(path, provenance)};
  const auto named = [&](const auto& write) {
    try {
      return write();
    } catch (const Error& e) {
      throw Error(fmt::format("{}: {}", path, e.what()));
    }
  };
  if (ending == ".glb") {
    write_file(path, named([&] { return write_glb(input, options.gpu_instancing); }));
    return triangles;
  }
  if (ending == ".ply") {
    write_file(path, named([&] { return write_ply(input); }));
    return triangles;
  }
  if (ending == ".stl") {
    write_file(path, named([&] { return write_stl(input); }));
    return triangles;
  }
  const ObjFiles files = named([&] { return write_obj(input, file.stem().string()); });
  std::vector<std::unique_ptr<StagedFile>> staged;
  const auto stage = [&](const std::filesystem::path& target, std::string_view bytes) {
    staged.push_back(std::make_unique<StagedFile>(target.string(), bytes));
  };
  stage(file, files.obj);
  stage(std::filesystem::path(file).replace_extension(".mtl"), files.mtl);
  for (const auto& [name, picture] : files.textures)
    stage(file.parent_path() / name, texture_bytes(*picture, &provenance));
  // All are whole by now. The OBJ gets its name last, for it names the others.
  for (std::size_t i = staged.size(); i-- > 0;) staged[i]->commit();
  return triangles;
}

}  // namespace espalier
