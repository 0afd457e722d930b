#pragma once
// Set: everything that a ray may meet, moved and scaled to unit size: the opaque and the translucent parts of a model,
// and the ghosts.

#include <memory>
#include <vector>

#include "model/parts.h"
#include "render/tracer.h"

namespace espalier {

struct Set {
  Tracer opaque, translucent, ghosts;
  std::vector<Material> materials;
  /// Corners of all parts' and ghosts' boxes, for the camera.
  std::vector<Vec3> corners;
  float lowest = 0;

  // What the tracers point into; addresses must not change.
  std::vector<std::unique_ptr<Mesh>> meshes;
  std::vector<std::unique_ptr<TriangleSet>> shapes;

  const Material& material(std::uint16_t index) const {
    static const Material kDefault;
    return index < materials.size() ? materials[index] : kDefault;
  }
};

Set build_set(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
              const std::vector<Mesh>& ghosts, bool full);

}  // namespace espalier
