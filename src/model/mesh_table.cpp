#include <filesystem>

#include "model/model.h"
#include "model/primitives.h"

namespace espalier {

MeshTable::MeshTable(const GeneratorGraph& graph, const std::string& folder, MeshSource& source) : refs_(graph.meshes) {
  meshes_.reserve(refs_.size());
  for (const MeshRef& ref : refs_) {
    if (ref.kind == MeshKind::file) {
      meshes_.push_back(source.load((std::filesystem::path(folder) / ref.path).string()));
      if (!ref.as_is) fit_to_unit_box(meshes_.back());
    } else {
      meshes_.push_back(make_primitive(ref.kind, 1, ref.sides));
    }
    bounds_.push_back(espalier::bounds(meshes_.back()));
  }
}

Bounds bounds(const Model& model, const MeshTable& meshes, bool full) {
  Bounds all;
  for (const Instance& instance : model.instances) {
    if (!(full ? in_full(instance) : in_parts(instance))) continue;
    Bounds local = meshes.mesh_bounds(instance.mesh);
    if (local.empty()) continue;
    if (meshes.ref(instance.mesh).kind == MeshKind::cone && instance.top > 1) {
      const float widest = instance.top;  // the table's cone has top = 1
      local.min *= Vec3(widest, 1, widest), local.max *= Vec3(widest, 1, widest);
    }
    for (int corner = 0; corner < 8; ++corner) {
      all.add(instance.model_from_mesh.point({corner & 1 ? local.max.x : local.min.x,
                                              corner & 2 ? local.max.y : local.min.y,
                                              corner & 4 ? local.max.z : local.min.z}));
    }
  }
  return all;
}

}  // namespace espalier
