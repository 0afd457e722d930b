#include "io/export.h"

#include <algorithm>
#include <filesystem>

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

void export_model(const std::string& path, const Model& model, const MeshTable& meshes,
                  const std::vector<Material>& materials, const Provenance& provenance,
                  const ExportOptions& options) {
  const std::filesystem::path file(path);
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (ending != ".glb" && ending != ".obj" && ending != ".ply" && ending != ".stl") {
    throw Error(fmt::format("{}: models are written as .glb, .obj, .ply or .stl, got \"{}\"", path, ending));
  }
  const Parts parts = collect_parts(model, meshes, options.full);
  const WriterInput input{parts, materials, provenance, model_name(path, provenance)};
  const auto named = [&](const auto& write) {
    try {
      return write();
    } catch (const Error& e) {
      throw Error(fmt::format("{}: {}", path, e.what()));
    }
  };
  if (ending == ".glb") return write_file(path, named([&] { return write_glb(input, options.gpu_instancing); }));
  if (ending == ".ply") return write_file(path, named([&] { return write_ply(input); }));
  if (ending == ".stl") return write_file(path, named([&] { return write_stl(input); }));
  const std::filesystem::path mtl = std::filesystem::path(file).replace_extension(".mtl");
  const ObjFiles files = named([&] { return write_obj(input, mtl.filename().string()); });
  StagedFile staged_obj(path, files.obj), staged_mtl(mtl.string(), files.mtl);
  staged_mtl.commit();
  staged_obj.commit();
}

}  // namespace espalier
