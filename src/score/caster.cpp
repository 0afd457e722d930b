#include "score/caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <glm/geometric.hpp>

#include "score/solid.h"

namespace espalier {
namespace {

DVec3 wide(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Corners that lie on one place are one corner.
void set_surface(Caster& caster, const Mesh& mesh) {
  std::map<std::tuple<float, float, float>, std::uint32_t> index_of;
  std::vector<std::uint32_t> merged;
  for (const Vec3& p : mesh.positions) {
    const auto next = static_cast<std::uint32_t>(caster.corners.size());
    const auto [it, fresh] = index_of.try_emplace({p.x, p.y, p.z}, next);
    if (fresh) caster.corners.push_back(p);
    merged.push_back(it->second);
  }
  for (const Triangle& t : mesh.triangles) {
    const Triangle corners = {merged[t[0]], merged[t[1]], merged[t[2]]};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      caster.triangles.push_back(corners);
  }
}

using EdgeFaces = std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>>;

EdgeFaces faces_by_edge(const Caster& caster) {
  EdgeFaces faces;
  for (std::size_t t = 0; t < caster.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = caster.triangles[t][k], b = caster.triangles[t][(k + 1) % 3];
      faces[{std::min(a, b), std::max(a, b)}].push_back(t);
    }
  }
  return faces;
}

DVec3 normal_of(const Caster& caster, const Triangle& t) {
  const DVec3 a = wide(caster.corners[t[0]]), b = wide(caster.corners[t[1]]), c = wide(caster.corners[t[2]]);
  const DVec3 across = glm::cross(b - a, c - a);
  const double length = glm::length(across);
  return length > 0 ? across / length : DVec3(0);
}

/// Edges of a closed convex mesh where two faces meet at an angle.
void set_bent_edges(Caster& caster) {
  for (const auto& [edge, faces] : faces_by_edge(caster)) {
    const DVec3 first = normal_of(caster, caster.triangles[faces.front()]);
    const DVec3 last = normal_of(caster, caster.triangles[faces.back()]);
    if (glm::dot(first, last) < 1 - 1e-9 || faces.size() != 2) caster.edges.push_back(edge);
  }
}

/// Sets the border of a flat mesh, if it is convex: all corners then lie on one side of each piece of it.
bool set_convex_border(Caster& caster) {
  DVec3 normal(0);
  for (const Triangle& t : caster.triangles)
    if (normal == DVec3(0)) normal = normal_of(caster, t);
  double size = 0;
  for (const Vec3& p : caster.corners) size = std::max(size, glm::length(wide(p) - wide(caster.corners[0])));
  for (const Vec3& p : caster.corners)
    if (std::abs(glm::dot(wide(p) - wide(caster.corners[0]), normal)) > 1e-6 * size) return false;
  for (const auto& [edge, faces] : faces_by_edge(caster)) {
    if (faces.size() == 2) continue;
    const DVec3 a = wide(caster.corners[edge[0]]), along = wide(caster.corners[edge[1]]) - a;
    double least = 0, most = 0;
    for (const Vec3& p : caster.corners) {
      const double side = glm::dot(glm::cross(along, wide(p) - a), normal);
      least = std::min(least, side), most = std::max(most, side);
    }
    if (faces.size() > 2 || (least < -1e-6 * size * size && most > 1e-6 * size * size)) return false;
    caster.edges.push_back(edge);
  }
  return normal != DVec3(0);
}

/// The ray in mesh space; false where the frame has no inverse.
bool to_mesh(const Instance& instance, const PixelRay& ray, DVec3& origin, DVec3& direction) {
  const Frame& m = instance.model_from_mesh;
  const DVec3 x = wide(m.basis[0]), y = wide(m.basis[1]), z = wide(m.basis[2]);
  const double det = glm::dot(x, glm::cross(y, z));
  if (!(std::abs(det) > 0)) return false;
  const auto solve = [&](const DVec3& v) {
    return DVec3(glm::dot(v, glm::cross(y, z)), glm::dot(x, glm::cross(v, z)), glm::dot(x, glm::cross(y, v))) / det;
  };
  origin = solve(ray.origin - wide(m.origin));
  direction = solve(ray.direction);
  return true;
}

/// Where a t^2 + 2 b t + c <= 0, cut to [low, high] where that is one stretch; a cone's second nappe is left out.
struct Stretch {
  double low, high;
  bool empty() const { return !(low <= high); }
};

bool meets_sphere(const DVec3& o, const DVec3& d, double least) {
  const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 0.25;
  const double root = b * b - a * c;
  return root >= 0 && (-b + std::sqrt(root)) / a >= least;
}

/// |xz| <= r(y) = (0.5 + 0.5 top) / 2 + (top - 1) / 2 * y, |y| <= 1/2.
bool meets_round(const DVec3& o, const DVec3& d, double top, double least) {
  Stretch slab{least, std::numeric_limits<double>::infinity()};
  if (d.y != 0) {
    const double t0 = (-0.5 - o.y) / d.y, t1 = (0.5 - o.y) / d.y;
    slab = {std::max(slab.low, std::min(t0, t1)), std::min(slab.high, std::max(t0, t1))};
  } else if (std::abs(o.y) > 0.5) {
    return false;
  }
  if (slab.empty()) return false;
  const double taper = 0.5 * (top - 1), middle = 0.25 * (1 + top);
  const double r = middle + taper * o.y, dr = taper * d.y;  // radius along the ray, >= 0 within the slab
  const double a = d.x * d.x + d.z * d.z - dr * dr, b = o.x * d.x + o.z * d.z - r * dr;
  const double c = o.x * o.x + o.z * o.z - r * r;
  const auto inside = [&](double t) { return (a * t + 2 * b) * t + c <= 0; };
  // Some point of the slab lies inside: an end of it, or a root within it, or all of an endless ray.
  if (std::isfinite(slab.low) && inside(slab.low)) return true;
  if (std::isfinite(slab.high) && inside(slab.high)) return true;
  const double root = b * b - a * c;
  if (!(root >= 0)) return false;
  if (a == 0) return b != 0 && -c / (2 * b) >= slab.low && -c / (2 * b) <= slab.high;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(root)) / a;
    if (t >= slab.low && t <= slab.high) return true;
  }
  return false;
}

bool meets_triangle(const DVec3& a, const DVec3& b, const DVec3& c, const PixelRay& ray) {
  const DVec3 e1 = b - a, e2 = c - a, p = glm::cross(ray.direction, e2);
  const double det = glm::dot(e1, p);
  if (det == 0) return false;
  const DVec3 s = ray.origin - a;
  const double u = glm::dot(s, p) / det;
  if (u < 0 || u > 1) return false;
  const DVec3 q = glm::cross(s, e1);
  const double v = glm::dot(ray.direction, q) / det;
  return v >= 0 && u + v <= 1 && glm::dot(e2, q) / det >= ray.least;
}

}  // namespace

Caster make_caster(const MeshRef& ref, const Mesh& mesh) {
  Caster caster;
  const bool wheel = ref.kind == MeshKind::cylinder || ref.kind == MeshKind::cone;
  caster.tapered = ref.kind == MeshKind::cone;
  if (ref.kind == MeshKind::sphere) caster.kind = Caster::Kind::sphere;
  else if (wheel && ref.sides >= kRoundFromSides) caster.kind = Caster::Kind::round;
  if (caster.kind != Caster::Kind::nothing) return caster;
  set_surface(caster, mesh);
  if (caster.triangles.empty()) return caster;
  caster.kind = ref.kind == MeshKind::box ? Caster::Kind::box : Caster::Kind::convex;
  if (ref.kind == MeshKind::box || wheel || !convex_planes(mesh).empty()) set_bent_edges(caster);
  else if (!set_convex_border(caster)) caster.kind = Caster::Kind::triangles, caster.edges.clear();
  if (!caster.tapered) caster.folds = FoldMesh(caster.corners, caster.triangles);
  return caster;
}

std::vector<Caster> make_casters(const MeshTable& meshes) {
  std::vector<Caster> casters;
  for (std::size_t i = 0; i < meshes.size(); ++i) casters.push_back(make_caster(meshes.ref(i), meshes.mesh(i)));
  return casters;
}

bool meets(const Caster& caster, const Instance& instance, const PixelRay& ray) {
  DVec3 o, d;
  const double top = caster.tapered ? std::max(instance.top, 0.0f) : 1.0;
  switch (caster.kind) {
    case Caster::Kind::nothing: return false;
    case Caster::Kind::sphere: return to_mesh(instance, ray, o, d) && meets_sphere(o, d, ray.least);
    case Caster::Kind::round: return to_mesh(instance, ray, o, d) && meets_round(o, d, top, ray.least);
    case Caster::Kind::box:
    case Caster::Kind::convex:
    case Caster::Kind::triangles: break;
  }
  const Frame& m = instance.model_from_mesh;
  const auto placed = [&](std::uint32_t i) {
    const Vec3& c = caster.corners[i];
    const double k = c.y > 0 ? top : 1;
    return wide(m.origin) + wide(m.basis[0]) * (k * c.x) + wide(m.basis[1]) * double{c.y} +
           wide(m.basis[2]) * (k * c.z);
  };
  return std::any_of(caster.triangles.begin(), caster.triangles.end(), [&](const Triangle& t) {
    return meets_triangle(placed(t[0]), placed(t[1]), placed(t[2]), ray);
  });
}

}  // namespace espalier
