#include "model/uv.h"

#include <cmath>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

Vec2 on_side(int side, const Vec3& p) {
  switch (side) {
    case 0: return {0.5f - p.z, p.y + 0.5f};
    case 1: return {p.z + 0.5f, p.y + 0.5f};
    case 2: return {p.x + 0.5f, 0.5f - p.z};
    case 3: return {p.x + 0.5f, p.z + 0.5f};
    case 4: return {p.x + 0.5f, p.y + 0.5f};
    default: return {0.5f - p.x, p.y + 0.5f};
  }
}

}  // namespace

int box_side(const Vec3& n) {
  constexpr float kTie = 1e-4f;  // for normals that are equal but for rounding
  const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  if (z + kTie >= x && z + kTie >= y) return n.z < 0 ? 5 : 4;
  if (x + kTie >= y) return n.x < 0 ? 1 : 0;
  return n.y < 0 ? 3 : 2;
}

Vec2 box_uv(const Vec3& position, const Vec3& normal) { return on_side(box_side(normal), position); }

Mesh with_uvs(const Mesh& mesh) {
  if (!mesh.uvs.empty()) return mesh;
  Mesh fitted;
  fitted.positions = mesh.positions;
  fit_to_unit_box(fitted);
  Mesh out;
  out.name = mesh.name;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> index_of;  // by position and side
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const Vec3 across = glm::cross(b - a, c - a);
    const float length = glm::length(across);
    const int side = box_side(length > 0 ? across / length : Vec3(0, 0, 1));
    Triangle split;
    for (int k = 0; k < 3; ++k) {
      const auto next = static_cast<std::uint32_t>(out.positions.size());
      const auto [it, fresh] = index_of.try_emplace({t[k], side}, next);
      split[k] = it->second;
      if (!fresh) continue;
      out.positions.push_back(mesh.positions[t[k]]);
      if (!mesh.normals.empty()) out.normals.push_back(mesh.normals[t[k]]);
      out.uvs.push_back(on_side(side, fitted.positions[t[k]]));
    }
    out.triangles.push_back(split);
  }
  return out;
}

}  // namespace espalier
