#pragma once
// Set: everything that a ray may meet, moved and scaled to unit size: the opaque and the translucent parts of a model,
// and the ghosts.

#include <memory>
#include <optional>
#include <vector>

#include "model/level_of_detail.h"
#include "model/parts.h"
#include "model/surfaces.h"
#include "render/tracer.h"

namespace espalier {

struct Set {
  Tracer opaque, translucent, ghosts;
  Surfaces surfaces;
  // unit_point = (model_point - centre) * scale
  glm::dvec3 centre{0};
  double scale = 1;
  Vec3 unit_point(const Vec3& p) const { return Vec3((glm::dvec3(p) - centre) * scale); }
  /// Corners of all parts' and ghosts' boxes, for the camera.
  std::vector<Vec3> corners;
  float lowest = 0;

  // What the tracers point into; addresses must not change.
  std::vector<std::unique_ptr<Mesh>> meshes;
  std::vector<std::unique_ptr<TriangleSet>> shapes;

  std::vector<std::unique_ptr<TextureSampler>> textures;
  std::vector<std::unique_ptr<Cutout>> cutouts;
  std::vector<const TextureSampler*> texture_of;  // per material; null: none

  const Material& material(std::uint16_t index) const { return surfaces.material(index); }
  const TextureSampler* texture(std::uint16_t index) const {
    return index < texture_of.size() ? texture_of[index] : nullptr;
  }
};

Set build_set(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
              const std::vector<Mesh>& ghosts, bool full, const std::optional<LevelOfDetail>& detail = {});

}  // namespace espalier
