#include "model/primitives.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "model/circle.h"
#include "model/uv.h"

namespace espalier {
namespace {

constexpr std::uint32_t kSphereSides = 32;

std::uint32_t add_vertex(Mesh& mesh, const Vec3& position, const Vec3& normal, const Vec2& uv) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.uvs.push_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// The share of the way around at side i, counted so that pictures on sides that run clockwise are not mirrored.
float around(std::uint32_t i, std::uint32_t sides) { return 1 - static_cast<float>(i) / static_cast<float>(sides); }

/// A flat convex face, corners counter-clockwise seen from outside.
void add_face(Mesh& mesh, std::initializer_list<Vec3> corners) {
  const Vec3* c = corners.begin();
  const Vec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& corner : corners) add_vertex(mesh, corner, normal, box_uv(corner, normal));
  for (std::uint32_t k = 2; k < corners.size(); ++k) mesh.triangles.push_back({first, first + k - 1, first + k});
}

Mesh make_box() {
  Mesh mesh;
  const float h = 0.5f;
  add_face(mesh, {{-h, -h, h}, {h, -h, h}, {h, h, h}, {-h, h, h}});
  add_face(mesh, {{h, -h, -h}, {-h, -h, -h}, {-h, h, -h}, {h, h, -h}});
  add_face(mesh, {{h, -h, h}, {h, -h, -h}, {h, h, -h}, {h, h, h}});
  add_face(mesh, {{-h, -h, -h}, {-h, -h, h}, {-h, h, h}, {-h, h, -h}});
  add_face(mesh, {{-h, h, h}, {h, h, h}, {h, h, -h}, {-h, h, -h}});
  add_face(mesh, {{-h, -h, -h}, {h, -h, -h}, {h, -h, h}, {-h, -h, h}});
  return mesh;
}

Mesh make_wedge() {
  Mesh mesh;
  const float h = 0.5f;
  add_face(mesh, {{-h, -h, h}, {h, -h, h}, {h, h, h}, {-h, h, h}});      // the high end
  add_face(mesh, {{-h, -h, -h}, {h, -h, -h}, {h, -h, h}, {-h, -h, h}});  // below
  add_face(mesh, {{-h, -h, -h}, {-h, h, h}, {h, h, h}, {h, -h, -h}});    // the ramp
  add_face(mesh, {{h, -h, -h}, {h, h, h}, {h, -h, h}});
  add_face(mesh, {{-h, -h, -h}, {-h, -h, h}, {-h, h, h}});
  return mesh;
}

Mesh make_pyramid() {
  Mesh mesh;
  const float h = 0.5f;
  const Vec3 apex(0, h, 0);
  add_face(mesh, {{-h, -h, -h}, {h, -h, -h}, {h, -h, h}, {-h, -h, h}});
  add_face(mesh, {{-h, -h, h}, {h, -h, h}, apex});
  add_face(mesh, {{h, -h, h}, {h, -h, -h}, apex});
  add_face(mesh, {{h, -h, -h}, {-h, -h, -h}, apex});
  add_face(mesh, {{-h, -h, -h}, {-h, -h, h}, apex});
  return mesh;
}

Mesh make_quad() {
  Mesh mesh;
  const float h = 0.5f;
  add_face(mesh, {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}});
  return mesh;
}

}  // namespace

Mesh make_leaf(LeafOutline outline) {
  const float h = 0.5f;
  Mesh mesh;
  mesh.name = "leaf";
  switch (outline) {
    case LeafOutline::plain:
      add_face(mesh, {{0, -h, 0}, {0.45f, -0.24f, 0}, {0.43f, 0.14f, 0}, {0, h, 0}, {-0.43f, 0.14f, 0},
                      {-0.45f, -0.24f, 0}});
      return mesh;
    case LeafOutline::coarse:
      add_face(mesh, {{0, -h, 0}, {h, -0.06f, 0}, {0, h, 0}, {-h, -0.06f, 0}});
      return mesh;
    case LeafOutline::fine: break;
  }
  add_face(mesh, {{0, -h, 0}, {0.28f, -0.40f, 0}, {0.45f, -0.24f, 0}, {h, -0.06f, 0}, {0.43f, 0.14f, 0},
                  {0.26f, 0.33f, 0}, {0, h, 0}, {-0.26f, 0.33f, 0}, {-0.43f, 0.14f, 0}, {-h, -0.06f, 0},
                  {-0.45f, -0.24f, 0}, {-0.28f, -0.40f, 0}});
  return mesh;
}

namespace {

/// A disc at height y, facing up or down.
void add_cap(Mesh& mesh, float y, float radius, std::uint32_t sides, bool up) {
  const Vec3 normal(0, up ? 1 : -1, 0);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const CirclePoint c = circle_point(i, sides);
    const Vec3 rim(static_cast<float>(c.cos), 0, static_cast<float>(c.sin));
    add_vertex(mesh, radius * rim + Vec3(0, y, 0), normal, box_uv(0.5f * rim, normal));
  }
  // The angle runs from +x to +z, which is clockwise seen from above.
  for (std::uint32_t k = 2; k < sides; ++k) {
    mesh.triangles.push_back(up ? Triangle{first, first + k, first + k - 1}
                                : Triangle{first, first + k - 1, first + k});
  }
}

Mesh make_cone(float top, std::uint32_t sides) {
  Mesh mesh;
  const float upper = 0.5f * top;
  // The side leans inwards by (0.5 - upper) over a height of 1.
  const double rise = 0.5 - static_cast<double>(upper), across = 1 / std::sqrt(1 + rise * rise);
  // The first side's points stand there twice: the picture's two edges meet there. At a tip it has as many middles.
  for (std::uint32_t i = 0; i <= sides; ++i) {
    const CirclePoint c = circle_point(i % sides, sides);
    const Vec3 normal(glm::dvec3(c.cos * across, rise * across, c.sin * across));
    const Vec3 outward(static_cast<float>(c.cos), 0, static_cast<float>(c.sin));
    const float u = around(i, sides), half = 0.5f / static_cast<float>(sides);
    add_vertex(mesh, 0.5f * outward - Vec3(0, 0.5f, 0), normal, {u, 0});
    add_vertex(mesh, upper * outward + Vec3(0, 0.5f, 0), normal, {upper > 0 ? u : std::max(u - half, 0.0f), 1});
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t low = 2 * i, next = low + 2;
    mesh.triangles.push_back({low, low + 1, next});
    if (upper > 0) mesh.triangles.push_back({next, low + 1, next + 1});
  }
  add_cap(mesh, -0.5f, 0.5f, sides, false);
  if (upper > 0) add_cap(mesh, 0.5f, upper, sides, true);
  return mesh;
}

}  // namespace

Mesh make_sphere(std::uint32_t sides) {
  CHECK(sides >= 3);
  Mesh mesh;
  mesh.name = "sphere";
  const std::uint32_t rings = std::max<std::uint32_t>(sides / 2, 2);
  const auto add = [&](const Vec3& direction, float u, float v) {
    add_vertex(mesh, 0.5f * direction, direction, {u, v});
  };
  const float half = 0.5f / static_cast<float>(sides);
  // The poles stand there once for each side, in the middle of its share of the picture's edge.
  for (std::uint32_t i = 0; i < sides; ++i) add({0, -1, 0}, around(i, sides) - half, 0);
  for (std::uint32_t r = 1; r < rings; ++r) {
    const CirclePoint ring = circle_point(r, 2 * rings);  // from the south pole upwards
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const CirclePoint c = circle_point(i % sides, sides);
      add(Vec3(glm::dvec3(ring.sin * c.cos, -ring.cos, ring.sin * c.sin)), around(i, sides),
          static_cast<float>(r) / static_cast<float>(rings));
    }
  }
  const auto top = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < sides; ++i) add({0, 1, 0}, around(i, sides) - half, 1);
  const auto at = [&](std::uint32_t ring, std::uint32_t i) { return sides + (ring - 1) * (sides + 1) + i; };
  for (std::uint32_t i = 0; i < sides; ++i) {
    mesh.triangles.push_back({i, at(1, i), at(1, i + 1)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, i), at(r + 1, i), at(r, i + 1)});
      mesh.triangles.push_back({at(r, i + 1), at(r + 1, i), at(r + 1, i + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, i), top + i, at(rings - 1, i + 1)});
  }
  return mesh;
}

Mesh make_primitive(MeshKind kind, float top, std::uint16_t sides) {
  CHECK(kind != MeshKind::file);
  const std::uint32_t facets = std::max<std::uint32_t>(sides, 3);
  Mesh mesh;
  switch (kind) {
    case MeshKind::box: mesh = make_box(), mesh.name = "box"; break;
    case MeshKind::cylinder: mesh = make_cone(1, facets), mesh.name = "cylinder"; break;
    case MeshKind::cone: mesh = make_cone(top > 0 ? top : 0, facets), mesh.name = "cone"; break;
    case MeshKind::sphere: mesh = make_sphere(kSphereSides); break;
    case MeshKind::wedge: mesh = make_wedge(), mesh.name = "wedge"; break;
    case MeshKind::pyramid: mesh = make_pyramid(), mesh.name = "pyramid"; break;
    case MeshKind::quad: mesh = make_quad(), mesh.name = "quad"; break;
    case MeshKind::leaf: mesh = make_leaf(LeafOutline::fine); break;
    case MeshKind::file: break;
  }
  return mesh;
}

}  // namespace espalier
