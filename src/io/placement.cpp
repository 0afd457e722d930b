#include "io/placement.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace espalier {
namespace {

constexpr double kMostShear = 3e-5;  // cosine between axes; long chains of turns in single precision stay below
constexpr double kFlat = 1e-8;       // shorter than this share of the longest axis counts as no length

/// Quaternion of a rotation matrix by Shepperd's method: the largest component first, for accuracy.
std::array<float, 4> quaternion(const glm::dmat3& m) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  int largest = 3;
  double most = trace;
  for (int i = 0; i < 3; ++i) {
    if (m[i][i] > most) most = m[i][i], largest = i;
  }
  std::array<double, 4> q{};
  if (largest == 3) {
    q = {m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0], 1 + trace};
  } else {
    const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1 + m[i][i] - m[j][j] - m[k][k];
    q[j] = m[i][j] + m[j][i];
    q[k] = m[i][k] + m[k][i];
    q[3] = m[j][k] - m[k][j];
  }
  double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (q[3] < 0) length = -length;
  std::array<float, 4> out;
  for (int i = 0; i < 4; ++i) out[i] = static_cast<float>(q[i] / length);
  return out;
}

bool orthogonal(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(glm::dot(a, b)) <= kMostShear * glm::length(a) * glm::length(b);
}

}  // namespace

std::optional<Placement> find_placement(const Frame& frame, const Bounds& shape_box) {
  glm::dmat3 axes(frame.basis);
  const double longest = std::max({glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])});
  const Vec3 shape_size = shape_box.size();
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &b = axes[(i + 1) % 3], &c = axes[(i + 2) % 3], across = glm::cross(b, c);
    const bool square = orthogonal(axes[i], b) && orthogonal(axes[i], c) && glm::length(axes[i]) > kFlat * longest;
    if (!square && shape_size[i] == 0 && glm::length(across) > 0) {
      axes[i] = across / glm::length(across);
      break;
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (!(glm::length(axes[i]) > kFlat * longest) || !orthogonal(axes[i], axes[(i + 1) % 3])) return std::nullopt;
  }
  Placement p;
  p.translation = frame.origin;
  glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  if (glm::determinant(axes) < 0) scale.x = -scale.x;
  p.scale = Vec3(scale);
  // Gram-Schmidt takes out the last of the shear.
  const glm::dvec3 x = axes[0] / scale.x, y = glm::normalize(axes[1] - glm::dot(axes[1], x) * x), z = glm::cross(x, y);
  p.rotation = quaternion(glm::dmat3(x, y, z));
  return p;
}

}  // namespace espalier
