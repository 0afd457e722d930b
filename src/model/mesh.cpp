#include "model/mesh.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

/// Thinner than this share of the longest side counts as flat: exporters leave such noise on planes.
constexpr double kFlatShare = 1e-6;

}  // namespace

std::vector<std::uint32_t> weld_by_position(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    for (int axis = 0; axis < 3; ++axis) {
      if (positions[a][axis] != positions[b][axis]) return positions[a][axis] < positions[b][axis];
    }
    return a < b;
  };
  std::sort(order.begin(), order.end(), before);
  std::vector<std::uint32_t> welded(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
  }
  return welded;
}

Bounds bounds(const Mesh& mesh) {
  Bounds box;
  for (const Vec3& p : mesh.positions) box.add(p);
  return box;
}

std::size_t open_edges(const Mesh& mesh) {
  const std::vector<std::uint32_t> welded = weld_by_position(mesh.positions);
  // One entry per use of an edge: its ends in ascending order, and the direction in which it was used.
  struct Use {
    std::uint32_t low, high;
    int direction;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = welded[t[k]], b = welded[t[(k + 1) % 3]];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const Use& p, const Use& q) { return p.low != q.low ? p.low < q.low : p.high < q.high; });
  std::size_t open = 0;
  for (std::size_t i = 0; i < uses.size();) {
    long balance = 0;
    std::size_t j = i;
    for (; j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high; ++j) {
      balance += uses[j].direction;
    }
    open += balance != 0;
    i = j;
  }
  return open;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    sum += glm::dot(a, glm::cross(b, c));
  }
  return sum / 6;
}

void fit_to_unit_box(Mesh& mesh) {
  const Bounds box = bounds(mesh);
  if (box.empty()) return;
  const glm::dvec3 low(box.min), high(box.max), size = high - low;
  const double longest = std::max({size.x, size.y, size.z});
  glm::dvec3 scale(0);
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] > kFlatShare * longest) scale[axis] = 1 / size[axis];
  }
  for (Vec3& p : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      // Measured from both ends, so that both land on +-0.5 exactly.
      const double from_low = (p[axis] - low[axis]) * scale[axis], from_high = (high[axis] - p[axis]) * scale[axis];
      p[axis] = static_cast<float>(0.5 * (from_low - from_high));
    }
  }
  for (Vec3& n : mesh.normals) {
    glm::dvec3 m(n);  // the inverse transpose of the scale; relative to the longest side against overflow
    for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis] > 0 ? size[axis] / longest : 1;
    const double length = glm::length(m);
    if (length > 0) n = Vec3(m / length);
  }
}

}  // namespace espalier
