#pragma once
// Shell: the surface of a model and nothing else: meshes, and where each of them stands. Triangles are placed one by
// one when they are asked for, so a model of a million parts costs no more memory than its parts.

#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "model/model.h"

namespace espalier {

struct ShellPart {
  Frame model_from_mesh;
  std::uint32_t mesh = 0;  // index into Shell::meshes
};

struct Shell {
  std::vector<Mesh> meshes;
  std::vector<ShellPart> parts;
};

/// A mesh in its own coordinates.
Shell shell_of(Mesh mesh);
/// What pictures and files show of a model: its parts and details, proxies left out.
Shell shell_of(const Model& model, const MeshTable& meshes);

/// As many as the files of the model would hold, those without area among them.
std::uint64_t triangle_count(const Shell& shell);

/// Triangles with less than this share of their longest side squared count as having no area. Single precision makes
/// such of points in a line, and they may stick out far from everything that is seen.
inline constexpr double kLeastAreaShare = 1e-6;

inline double area(const DVec3& a, const DVec3& b, const DVec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

inline bool has_area(const DVec3& a, const DVec3& b, const DVec3& c) {
  const DVec3 sides[] = {b - a, c - b, a - c};
  double longest = 0;  // squared
  for (const DVec3& side : sides) longest = glm::dot(side, side) > longest ? glm::dot(side, side) : longest;
  return area(a, b, c) > kLeastAreaShare * longest;
}

/// Calls visit(a, b, c) for the corners, in model space, of every triangle that has an area, in the order of the parts.
template <class Visit>
void for_each_triangle(const Shell& shell, const Visit& visit) {
  for (const ShellPart& part : shell.parts) {
    const Mesh& mesh = shell.meshes[part.mesh];
    // In single precision, as files hold them.
    const auto corner = [&](std::uint32_t i) { return DVec3(part.model_from_mesh.point(mesh.positions[i])); };
    for (const Triangle& t : mesh.triangles) {
      const DVec3 a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
      if (has_area(a, b, c)) visit(a, b, c);
    }
  }
}

/// The box around the triangles that have an area; empty where there are none.
Bounds bounds(const Shell& shell);

}  // namespace espalier
