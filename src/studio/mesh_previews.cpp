#include "studio/mesh_previews.h"

#include <filesystem>
#include <vector>

#include "io/file.h"
#include "io/mesh_import.h"
#include "io/png.h"
#include "render/render.h"
#include "run/temporary_folder.h"

namespace espalier::studio {

std::string MeshPreviews::draw(const std::string& path, const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string name = std::filesystem::path(path).filename().string();
  write_file(folder.file(name), bytes);
  GeneratorGraph graph;
  graph.meshes.push_back({.kind = MeshKind::file, .as_is = true, .path = name, .span = {}});
  AssimpMeshSource source({Store::kMostFileBytes, kMostTriangles});
  const MeshTable meshes(graph, folder.file(""), source);
  Model model;
  model.instances.push_back({});
  Material clay;
  clay.color = Vec3(0.55f, 0.56f, 0.58f);
  clay.two_sided = true;
  RenderSettings look;
  look.width = kWidth, look.height = kHeight;
  look.ground = false;
  look.transparent = true;
  const Picture picture = render(model, meshes, Surfaces({clay}), {}, look, *make_serial_executor());
  std::vector<std::uint8_t> rgba(4 * std::size_t{kWidth} * kHeight, 255);
  for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba[4 * i + c] = picture.rgb[3 * i + c];
    if (!picture.alpha.empty()) rgba[4 * i + 3] = picture.alpha[i];
  }
  return encode_png_with_alpha(kWidth, kHeight, rgba);
}

}  // namespace espalier::studio
