#include "studio/mesh_forms.h"

#include <filesystem>

#include "io/file.h"
#include "io/mesh_import.h"
#include "run/temporary_folder.h"
#include "studio/model_message.h"
#include "studio/shipped.h"

namespace espalier::studio {

std::string MeshForms::make(const std::string& path, const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string name = std::filesystem::path(path).filename().string();
  write_file(folder.file(name), bytes);
  const Mesh mesh = AssimpMeshSource({Store::kMostFileBytes, kMostFileTriangles}).load(folder.file(name));
  return mesh_message(static_cast<std::uint32_t>(mesh.triangles.size()), mesh, kMostTriangles);
}

}  // namespace espalier::studio
