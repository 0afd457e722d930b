#pragma once
// ReferenceDescriptor: what describe() must come to, by rejection: points are drawn from the whole surface, and those
// in the voxel are kept. Slow and plain on purpose; no code shared with the descriptor, another generator of numbers.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "model/shell.h"

namespace espalier::test {

class ReferenceDescriptor {
 public:
  using Point = std::array<double, 3>;

  /// The shell's meshes are taken as they stand, without their frames' rounding.
  ReferenceDescriptor(const Shell& shell, std::uint32_t layers, std::uint32_t seed) : layers_(layers), random_(seed) {
    for (const ShellPart& part : shell.parts) {
      for (const Triangle& t : shell.meshes[part.mesh].triangles) {
        std::array<Point, 3> corners;
        for (int k = 0; k < 3; ++k) {
          const Vec3 p = part.model_from_mesh.point(shell.meshes[part.mesh].positions[t[static_cast<std::size_t>(k)]]);
          corners[static_cast<std::size_t>(k)] = {p.x, p.y, p.z};
        }
        add(corners);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double grow = 0.0005 * (high_[i] - low_[i]);
      low_[i] -= grow, high_[i] += grow;
    }
  }

  double area() const { return areas_.empty() ? 0 : areas_.back(); }

  /// Draws this many points, and keeps them by voxel, in the order in which they came.
  std::vector<std::vector<Point>> points(std::size_t count) {
    std::vector<std::vector<Point>> kept(std::size_t{layers_} * layers_ * layers_);
    std::uniform_real_distribution<double> unit(0, 1);
    for (std::size_t n = 0; n < count; ++n) {
      const double at = unit(random_) * area();
      const auto i = static_cast<std::size_t>(std::upper_bound(areas_.begin(), areas_.end(), at) - areas_.begin());
      const std::array<Point, 3>& t = triangles_[std::min(i, triangles_.size() - 1)];
      double u = unit(random_), v = unit(random_);
      if (u + v > 1) u = 1 - u, v = 1 - v;  // the other half of the parallelogram
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = t[0][k] + u * (t[1][k] - t[0][k]) + v * (t[2][k] - t[0][k]);
      kept[voxel(p)].push_back(p);
    }
    return kept;
  }

 private:
  void add(const std::array<Point, 3>& t) {
    Point cross;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      cross[i] = (t[1][j] - t[0][j]) * (t[2][k] - t[0][k]) - (t[1][k] - t[0][k]) * (t[2][j] - t[0][j]);
    }
    const double twice = std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    if (twice == 0) return;
    triangles_.push_back(t);
    areas_.push_back(area() + twice / 2);
    for (const Point& p : t) {
      for (std::size_t i = 0; i < 3; ++i) low_[i] = std::min(low_[i], p[i]), high_[i] = std::max(high_[i], p[i]);
    }
  }

  std::size_t voxel(const Point& p) const {
    std::size_t index = 0;
    for (std::size_t i = 3; i-- > 0;) {
      const double share = (p[i] - low_[i]) / (high_[i] - low_[i]);
      const auto layer = high_[i] > low_[i] ? static_cast<std::size_t>(share * layers_) : layers_ / 2;
      index = index * layers_ + std::min<std::size_t>(layer, layers_ - 1);
    }
    return index;
  }

  std::uint32_t layers_;
  std::mt19937_64 random_;
  std::vector<std::array<Point, 3>> triangles_;
  std::vector<double> areas_;  // of this triangle and all before
  Point low_{1e300, 1e300, 1e300}, high_{-1e300, -1e300, -1e300};
};

}  // namespace espalier::test
