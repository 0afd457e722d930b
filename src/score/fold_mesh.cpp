#include "score/fold_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

DVec3 wide(const Vec3& v) { return {v.x, v.y, v.z}; }
double det(const DVec3& a, const DVec3& b, const DVec3& c) { return glm::dot(a, glm::cross(b, c)); }
std::size_t whole_eights(std::size_t n) { return (n + 7) / 8 * 8; }

/// Faces by the edges that they run along, from the lower corner up and from the upper down.
struct EdgeUse {
  std::vector<std::uint32_t> up, down;
};

/// The box lies on the far side of one of the lines through the middles of the image's outermost pixels.
bool beside_image(const Projection& projection, const DVec3& middle, const DVec3 axis[3], const DVec3& half) {
  for (int i = 0; i < 2; ++i) {
    const double most = (i == 0 ? projection.width : projection.height) - 0.5;
    double low = middle[i] - most * middle.z, high = middle[i] - 0.5 * middle.z;
    for (int j = 0; j < 3; ++j) {
      low -= std::abs(axis[j][i] - most * axis[j].z) * half[j];
      high += std::abs(axis[j][i] - 0.5 * axis[j].z) * half[j];
    }
    if (low > 0 || high < 0) return true;
  }
  return false;
}

void set_edges(std::span<const Triangle> triangles, FoldMesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, EdgeUse> uses;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      EdgeUse& use = uses[{std::min(a, b), std::max(a, b)}];
      (a < b ? use.up : use.down).push_back(t);
    }
  }
  for (const auto& [edge, use] : uses) {
    const std::size_t pairs = std::min(use.up.size(), use.down.size());
    for (std::size_t i = 0; i < pairs; ++i) mesh.folds.push_back({edge[0], edge[1], use.up[i], use.down[i]});
    for (std::size_t i = pairs; i < use.up.size(); ++i) mesh.borders.push_back({edge[0], edge[1], use.up[i]});
    for (std::size_t i = pairs; i < use.down.size(); ++i) mesh.borders.push_back({edge[1], edge[0], use.down[i]});
  }
}

}  // namespace

FoldMesh::FoldMesh(std::span<const Vec3> corners_in, std::span<const Triangle> triangles)
    : corners(corners_in.size()), faces(triangles.size()) {
  if (triangles.empty()) return;
  Bounds box;
  for (const Vec3& p : corners_in) box.add(p);
  middle = 0.5 * (wide(box.min) + wide(box.max)), half = 0.5 * (wide(box.max) - wide(box.min));
  for (int i = 0; i < 3; ++i) {
    for (const Vec3& p : corners_in) place[i].push_back(p[i]);
    place[i].resize(whole_eights(corners), place[i].back());
  }
  for (const Triangle& t : triangles) {
    const DVec3 a = wide(corners_in[t[0]]), b = wide(corners_in[t[1]]), c = wide(corners_in[t[2]]);
    const DVec3 normal = glm::cross(b - a, c - a);
    const double offset = glm::dot(normal, a - middle);
    const double most = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z), std::abs(offset)});
    const double scale = most > 0 ? 1 / most : 0;  // floats would not hold the square of a large mesh
    for (int i = 0; i < 3; ++i) plane[i].push_back(static_cast<float>(normal[i] * scale));
    plane[3].push_back(static_cast<float>(offset * scale));
  }
  for (auto& list : plane) list.resize(whole_eights(faces), 0);
  set_edges(triangles, *this);
}

FoldView::Result FoldView::set(const FoldMesh& mesh, const Projection& projection, const Frame& frame) {
  DVec3 axis[3], far(0);
  for (int j = 0; j < 3; ++j) {
    axis[j] = projection.vector(wide(frame.basis[j]));
    far += glm::abs(axis[j]) * mesh.half[j];
  }
  const DVec3 base = projection.point(wide(frame.origin));
  DVec3 middle = base + axis[0] * mesh.middle.x + axis[1] * mesh.middle.y + axis[2] * mesh.middle.z;
  const double size = far.x + far.y + far.z + std::abs(middle.x) + std::abs(middle.y) + std::abs(middle.z);
  if (!(size < 1e30)) return Result::careful;
  if (middle.z + far.z < projection.nearest) return Result::nothing;
  if (!(middle.z - far.z >= projection.nearest)) return Result::careful;
  if (beside_image(projection, middle, axis, mesh.half)) return Result::nothing;
  const double column = middle.x / middle.z, row = middle.y / middle.z;
  if (!(std::abs(column) < 1e6 && std::abs(row) < 1e6)) return Result::careful;
  origin[0] = static_cast<std::int32_t>(column), origin[1] = static_cast<std::int32_t>(row);

  const auto shifted = [&](const DVec3& v) { return DVec3(v.x - origin[0] * v.z, v.y - origin[1] * v.z, v.z); };
  for (DVec3& a : axis) a = shifted(a);
  const DVec3 start = shifted(base);
  middle = shifted(middle);
  for (int r = 0; r < 3; ++r) {
    for (int j = 0; j < 3; ++j) matrix[r][j] = axis[j][r];
    matrix[r][3] = start[r];
  }
  // The turn of a triangle abc in the image is det(M [a b c]) = sum of minors of M times minors of [a b c]
  // (Cauchy and Binet), and the latter are its plane.
  const double minors[4] = {det(axis[1], axis[2], middle), -det(axis[0], axis[2], middle),
                            det(axis[0], axis[1], middle), det(axis[0], axis[1], axis[2])};
  double most = 0;
  for (const double m : minors) most = std::max(most, std::abs(m));
  for (int i = 0; i < 4; ++i) eye[i] = static_cast<float>(most > 0 ? minors[i] / most : 0);
  return Result::ready;
}

}  // namespace espalier
