#include "render/crease.h"

#include <glm/geometric.hpp>

namespace espalier {
namespace {

constexpr double kCreaseCosine = 0.77;

}  // namespace

Mesh with_crease_normals(const Mesh& mesh) {
  const std::vector<std::uint32_t> welded = weld_by_position(mesh.positions);
  std::vector<glm::dvec3> areas, normals;  // per triangle: normal times twice the area; unit normal
  std::vector<const Triangle*> faces;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    const glm::dvec3 area = glm::cross(b - a, c - a);
    const double length = glm::length(area);
    if (!(length > 0)) continue;
    faces.push_back(&t), areas.push_back(area), normals.push_back(area / length);
  }
  // Lists of the faces around each position, end to end.
  std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);
  for (const Triangle* t : faces) {
    for (const std::uint32_t corner : *t) ++first[welded[corner] + 1];
  }
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::uint32_t> around(3 * faces.size()), next(first.begin(), first.end() - 1);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (const std::uint32_t corner : *faces[f]) around[next[welded[corner]]++] = f;
  }

  Mesh out;
  out.name = mesh.name;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto start = static_cast<std::uint32_t>(out.positions.size());
    for (const std::uint32_t corner : *faces[f]) {
      glm::dvec3 sum(0);
      for (std::uint32_t i = first[welded[corner]]; i < first[welded[corner] + 1]; ++i) {
        if (glm::dot(normals[f], normals[around[i]]) >= kCreaseCosine) sum += areas[around[i]];
      }
      out.positions.push_back(mesh.positions[corner]);
      out.normals.emplace_back(glm::normalize(sum));
    }
    out.triangles.push_back({start, start + 1, start + 2});
  }
  return out;
}

}  // namespace espalier
