#include "score/solid.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier {
namespace {

using Vec3d = std::array<double, 3>;

Vec3d to_double(const Vec3& v) { return {double{v.x}, double{v.y}, double{v.z}}; }
Vec3d minus(const Vec3d& a, const Vec3d& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec3d& a, const Vec3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Every edge, by positions, is used once in each direction: one closed sheet that never touches itself along an edge.
bool simply_closed(const Mesh& mesh) {
  std::map<Vec3d, std::uint32_t> welded;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  std::vector<std::uint32_t> id;
  id.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    id.push_back(welded.try_emplace(to_double(p), static_cast<std::uint32_t>(welded.size())).first->second);
  }
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++uses[{id[t[k]], id[t[(k + 1) % 3]]}];
  }
  return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
    const auto back = uses.find({use.first.second, use.first.first});
    return use.second == 1 && back != uses.end() && back->second == 1;
  });
}

bool same_plane(const Plane& a, const Plane& b, double size) {
  const Vec3d d = minus(a.normal, b.normal);
  return dot(d, d) < 1e-14 && std::abs(a.offset - b.offset) < 1e-7 * size;
}

/// The different planes of the triangles, turned outwards by `sign`; stops beyond kMostPlanes.
std::vector<Plane> planes_of(const Mesh& mesh, double sign, double size) {
  std::vector<Plane> planes;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = to_double(mesh.positions[t[0]]);
    const Vec3d n = cross(minus(to_double(mesh.positions[t[1]]), a), minus(to_double(mesh.positions[t[2]]), a));
    const double length = std::sqrt(dot(n, n));
    if (!(length > 1e-12 * size * size)) continue;  // no area, no plane
    Plane plane{{sign * n[0] / length, sign * n[1] / length, sign * n[2] / length}, 0};
    plane.offset = dot(plane.normal, a);
    const bool known = std::any_of(planes.begin(), planes.end(),
                                   [&](const Plane& other) { return same_plane(plane, other, size); });
    if (!known) planes.push_back(plane);
    if (planes.size() > Solid::kMostPlanes) break;
  }
  return planes;
}

void set_box(Solid& solid, const Mesh& mesh) {
  const Bounds box = bounds(mesh);
  if (box.empty()) return;
  for (int i = 0; i < 3; ++i) {
    solid.centre[i] = 0.5 * (double{box.min[i]} + double{box.max[i]});
    solid.half[i] = 0.5 * (double{box.max[i]} - double{box.min[i]});
  }
}

void set_unit_box(Solid& solid) {
  for (int i = 0; i < 3; ++i) solid.centre[i] = 0, solid.half[i] = 0.5;
}

Solid make_file_solid(const Mesh& mesh) {
  Solid solid;
  set_box(solid, mesh);
  solid.planes = convex_planes(mesh);
  solid.kind = solid.planes.empty() ? SolidKind::facets : SolidKind::convex;
  if (solid.kind == SolidKind::facets) {
    solid.mesh.positions = mesh.positions;
    solid.mesh.triangles = mesh.triangles;
  }
  return solid;
}

/// A drawn cylinder or cone of few sides: keeps the planes of the sides, from which any top follows.
Solid make_prism(const Mesh& mesh, bool tapered) {
  Solid solid;
  solid.kind = SolidKind::prism;
  solid.tapered = tapered;
  set_box(solid, mesh);
  solid.planes = convex_planes(mesh);
  std::erase_if(solid.planes, [](const Plane& plane) { return std::abs(plane.normal[1]) > 0.5; });
  return solid;
}

}  // namespace

std::vector<Plane> convex_planes(const Mesh& mesh) {
  const Bounds box = bounds(mesh);
  if (mesh.triangles.empty() || box.empty()) return {};
  const Vec3 extent = box.size();
  const double size = std::max({extent.x, extent.y, extent.z});
  const double content = volume(mesh);
  if (!(std::abs(content) > 1e-12 * size * size * size)) return {};
  std::vector<Plane> planes = planes_of(mesh, content > 0 ? 1 : -1, size);
  if (planes.size() > Solid::kMostPlanes) return {};
  for (const Plane& plane : planes) {
    for (const Vec3& p : mesh.positions) {
      if (dot(plane.normal, to_double(p)) > plane.offset + 1e-6 * size) return {};
    }
  }
  if (!simply_closed(mesh)) return {};
  return planes;
}

Solid make_solid(const MeshRef& ref, const Mesh& mesh) {
  Solid solid;
  switch (ref.kind) {
    case MeshKind::quad:
    case MeshKind::leaf:
      return solid;
    case MeshKind::box:
      solid.kind = SolidKind::box;
      set_unit_box(solid);
      return solid;
    case MeshKind::sphere:
      solid.kind = SolidKind::sphere;
      set_unit_box(solid);
      return solid;
    case MeshKind::cylinder:
    case MeshKind::cone:
      if (ref.sides < kRoundFromSides) return make_prism(mesh, ref.kind == MeshKind::cone);
      solid.kind = SolidKind::round;
      solid.tapered = ref.kind == MeshKind::cone;
      set_unit_box(solid);
      return solid;
    case MeshKind::wedge:
    case MeshKind::pyramid:
    case MeshKind::file:
      return make_file_solid(mesh);
  }
  return solid;
}

std::vector<Solid> make_solids(const MeshTable& meshes) {
  std::vector<Solid> solids;
  solids.reserve(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) solids.push_back(make_solid(meshes.ref(i), meshes.mesh(i)));
  return solids;
}

}  // namespace espalier
