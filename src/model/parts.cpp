#include "model/parts.h"

#include <bit>
#include <map>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/check.h"
#include "model/primitives.h"
#include "model/surface_scale.h"

namespace espalier {
namespace {

glm::dvec3 face_normal(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  const glm::dvec3 across = glm::cross(b - a, c - a);
  const double length = glm::length(across);
  return length > 0 ? across / length : glm::dvec3(0);
}

/// Keeps the triangles with an area, and the positions that they use.
Mesh without_slivers(const Mesh& mesh) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  Mesh kept;
  kept.name = mesh.name;
  kept.triangles.reserve(mesh.triangles.size());
  std::vector<std::uint32_t> index_of(mesh.positions.size(), kUnused);
  for (const Triangle& t : mesh.triangles) {
    if (face_normal(mesh, t) == glm::dvec3(0)) continue;
    Triangle renumbered;
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& index = index_of[t[k]];
      if (index == kUnused) {
        index = static_cast<std::uint32_t>(kept.positions.size());
        kept.positions.push_back(mesh.positions[t[k]]);
        kept.normals.push_back(mesh.normals[t[k]]);
        if (!mesh.uvs.empty()) kept.uvs.push_back(mesh.uvs[t[k]]);
      }
      renumbered[k] = index;
    }
    kept.triangles.push_back(renumbered);
  }
  return kept;
}

/// The ratio that tells two cones apart; every other mesh has only one shape.
float ratio_of(const Instance& instance, const MeshRef& ref) {
  return ref.kind == MeshKind::cone && instance.top > 0 ? instance.top : 0;
}

/// What tells the shapes of two instances apart. Sizes count only where pictures are to scale.
struct ShapeKey {
  std::uint16_t mesh;
  std::uint32_t ratio;
  float metres;  // of a picture; 0: one picture per part
  PartSize size;
  auto operator<=>(const ShapeKey&) const = default;
};

float scale_of(const Material& material) { return material.textured() ? material.metres : 0; }

}  // namespace

Mesh with_normals(const Mesh& mesh) {
  CHECK(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
  if (!mesh.normals.empty()) {
    CHECK(mesh.normals.size() == mesh.positions.size());
    return without_slivers(mesh);
  }
  Mesh split;
  split.name = mesh.name;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 normal = face_normal(mesh, t);
    if (normal == glm::dvec3(0)) continue;
    const auto first = static_cast<std::uint32_t>(split.positions.size());
    for (const std::uint32_t corner : t) {
      split.positions.push_back(mesh.positions[corner]);
      split.normals.emplace_back(normal);
      if (!mesh.uvs.empty()) split.uvs.push_back(mesh.uvs[corner]);
    }
    split.triangles.push_back({first, first + 1, first + 2});
  }
  return split;
}

bool is_shown(const Instance& instance, bool full) {
  return (full ? in_full(instance) : in_parts(instance)) && can_be_shown(instance.model_from_mesh);
}

Parts collect_parts(const Model& model, const MeshTable& meshes, bool full, const std::vector<Material>& materials) {
  Parts out;
  std::map<ShapeKey, std::uint32_t> shape_of;
  for (const Instance& instance : model.instances) {
    if (!is_shown(instance, full)) continue;
    const MeshRef& ref = meshes.ref(instance.mesh);
    const float ratio = ratio_of(instance, ref);
    ShapeKey key{instance.mesh, std::bit_cast<std::uint32_t>(ratio), 0, {}};
    if (instance.material < materials.size()) key.metres = scale_of(materials[instance.material]);
    if (ref.kind == MeshKind::file) key.metres = 0;
    if (key.metres > 0) key.size = PartSize(instance.model_from_mesh.basis);
    const auto [it, fresh] = shape_of.try_emplace(key, static_cast<std::uint32_t>(out.shapes.size()));
    if (fresh) {
      const bool cone = ref.kind == MeshKind::cone;
      const Mesh mesh = cone ? make_primitive(ref.kind, ratio, ref.sides) : meshes.mesh(instance.mesh);
      Shape& shape = out.shapes.emplace_back();
      shape.mesh = with_normals(mesh);
      if (key.metres > 0) scale_uvs(shape.mesh, ref.kind, ratio, key.size.metres(), key.metres);
      shape.box = bounds(shape.mesh);
      shape.open = open_edges(mesh) > 0;
    }
    out.parts.push_back({instance.model_from_mesh, it->second, instance.material, instance.gene});
  }
  return out;
}

Mesh baked(const Shape& shape, const Frame& model_from_shape) {
  const glm::dmat3 basis(model_from_shape.basis);
  const bool mirrored = glm::determinant(basis) < 0;
  // Normals go by the cofactors: the inverse transpose times the determinant, which flat parts have too.
  const double sign = mirrored ? -1 : 1;
  const glm::dmat3 cofactors(sign * glm::cross(basis[1], basis[2]), sign * glm::cross(basis[2], basis[0]),
                             sign * glm::cross(basis[0], basis[1]));
  Mesh mesh = shape.mesh;
  for (Vec3& p : mesh.positions) p = model_from_shape.point(p);
  for (Vec3& n : mesh.normals) {
    const glm::dvec3 turned = cofactors * glm::dvec3(n);
    const double length = glm::length(turned);
    n = length > 0 ? Vec3(turned / length) : Vec3(0);
  }
  if (mirrored) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  bool lost_normal = false;
  for (const Vec3& n : mesh.normals) lost_normal |= n == Vec3(0);
  if (lost_normal) mesh.normals.clear();  // smooth sides that collapsed: shade flat
  return with_normals(mesh);
}

}  // namespace espalier
