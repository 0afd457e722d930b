#include "run/shown_model.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "model/expand.h"
#include "run/find_derivation.h"

namespace espalier {

bool names_mesh(const std::string& path) {
  std::error_code ignored;
  return !path.ends_with(".json") && !path.ends_with(".png") && !std::filesystem::is_directory(path, ignored);
}

ShownModel load_shown_model(const std::string& path, const std::string& grammar,
                            const std::map<std::string, std::string>& attributes, MeshSource& source,
                            std::uint64_t most_triangles) {
  ShownModel shown;
  shown.is_mesh = names_mesh(path);
  if (shown.is_mesh) {
    shown.shell = shell_of(source.load(path));
  } else {
    const LoadedDerivation loaded = load_derivation(find_derivation(path), grammar, attributes);
    Model model;
    Expander(*loaded.grammar.graph, {.make_materials = false}).expand(loaded.derivation, ExpandTo::full, model);
    shown.shell = shell_of(model, load_meshes(loaded.grammar, source));
    shown.adapted = loaded.adapted, shown.truncated = model.truncated;
  }
  if (const std::uint64_t triangles = triangle_count(shown.shell); triangles > most_triangles)
    throw Error(fmt::format("{}: must have at most {} triangles, got {}", path, most_triangles, triangles));
  return shown;
}

}  // namespace espalier
