#include "model/shell.h"

#include <utility>

#include "model/parts.h"

namespace espalier {

Shell shell_of(Mesh mesh) {
  Shell shell;
  shell.meshes.push_back(std::move(mesh));
  shell.parts.push_back({});
  return shell;
}

Shell shell_of(const Model& model, const MeshTable& meshes) {
  Parts shown = collect_parts(model, meshes, true);
  Shell shell;
  for (Shape& shape : shown.shapes) shell.meshes.push_back(std::move(shape.mesh));
  shell.parts.reserve(shown.parts.size());
  for (const Part& part : shown.parts) shell.parts.push_back({part.model_from_shape, part.shape});
  return shell;
}

std::uint64_t triangle_count(const Shell& shell) {
  std::uint64_t count = 0;
  for (const ShellPart& part : shell.parts) count += shell.meshes[part.mesh].triangles.size();
  return count;
}

Bounds bounds(const Shell& shell) {
  Bounds box;
  for_each_triangle(shell, [&](const DVec3& a, const DVec3& b, const DVec3& c) {
    for (const DVec3& p : {a, b, c}) box.add(Vec3(p));
  });
  return box;
}

}  // namespace espalier
