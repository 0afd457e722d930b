#include "score/reference_volume.h"

#include <algorithm>
#include <cmath>

#include "model/primitives.h"
#include "score/solid.h"

namespace espalier {
namespace {

/// The ray from p upwards along z, or downwards, meets the triangle.
enum class Meets { no, above, below };
Meets meets(const double* a, const double* b, const double* c, const double p[3]) {
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (area == 0) return Meets::no;
  const double u = ((p[0] - a[0]) * (c[1] - a[1]) - (p[1] - a[1]) * (c[0] - a[0])) / area;
  const double v = ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / area;
  if (u < 0 || v < 0 || u + v > 1) return Meets::no;
  const double z = a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]);
  return z > p[2] ? Meets::above : Meets::below;
}

}  // namespace

ReferencePart::ReferencePart(const MeshRef& ref, const Mesh& mesh, const Instance& instance, const Vec3& cell)
    : kind_(ref.kind), mesh_(mesh) {
  for (int i = 0; i < 3; ++i) low_[i] = 1, high_[i] = -1;
  const bool tapered = kind_ == MeshKind::cone;
  if (tapered) top_ = instance.top > 0 ? double{instance.top} : 0.0;
  if (kind_ == MeshKind::quad || kind_ == MeshKind::leaf || std::isnan(tapered ? instance.top : 0.0f)) return;
  const bool few_sides = (kind_ == MeshKind::cylinder || tapered) && ref.sides < kRoundFromSides;
  if (few_sides) mesh_ = make_primitive(kind_, static_cast<float>(top_), ref.sides);
  by_facets_ = few_sides || kind_ == MeshKind::file || kind_ == MeshKind::wedge || kind_ == MeshKind::pyramid;

  place(instance.model_from_mesh);
  const Bounds box = by_facets_ ? bounds(mesh_) : Bounds{Vec3(-0.5f), Vec3(0.5f)};
  const double wide = tapered && !few_sides ? std::max(1.0, top_) : 1.0;
  double size[3];
  for (int j = 0; j < 3; ++j) size[j] = double{box.max[j]} - double{box.min[j]};
  if (!finite() || (kind_ != MeshKind::file && flat(cell, size))) return;
  empty_ = false;
  set_box(box, wide);
  if (by_facets_) set_corners();
}

/// The box of the placed mesh box, which is `wide` times as wide across y.
void ReferencePart::set_box(const Bounds& box, double wide) {
  for (int i = 0; i < 3; ++i) {
    low_[i] = high_[i] = origin_[i];
    for (int j = 0; j < 3; ++j) {
      const double s = j == 1 ? 1 : wide;
      const double a = basis_[i][j] * s * double{box.min[j]}, b = basis_[i][j] * s * double{box.max[j]};
      low_[i] += std::min(a, b);
      high_[i] += std::max(a, b);
    }
  }
}

void ReferencePart::set_corners() {
  for (const Triangle& t : mesh_.triangles) {
    for (const std::uint32_t corner : t) {
      const Vec3& p = mesh_.positions[corner];
      for (int i = 0; i < 3; ++i) {
        corner_.push_back(basis_[i][0] * double{p.x} + basis_[i][1] * double{p.y} + basis_[i][2] * double{p.z} +
                          origin_[i]);
      }
    }
  }
}

void ReferencePart::place(const Frame& frame) {
  for (int i = 0; i < 3; ++i) {
    origin_[i] = double{frame.origin[i]};
    for (int j = 0; j < 3; ++j) basis_[i][j] = double{frame.basis[j][i]};
  }
  const auto& b = basis_;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      inverse_[j][i] = b[i1][j1] * b[i2][j2] - b[i1][j2] * b[i2][j1];
    }
  }
  const double det = b[0][0] * inverse_[0][0] + b[1][0] * inverse_[0][1] + b[2][0] * inverse_[0][2];
  for (auto& row : inverse_) {
    for (double& v : row) v /= det;
  }
}

/// NaN, infinity and what lies beyond 1e30 metres cover nothing.
bool ReferencePart::finite() const {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += std::abs(origin_[i]) + std::abs(basis_[i][0]) + std::abs(basis_[i][1]) + std::abs(basis_[i][2]);
  }
  return sum < 1e30;
}

/// Opposite faces of the mesh's box lie less than a millionth of a cell apart.
bool ReferencePart::flat(const Vec3& cell, const double size[3]) const {
  for (int j = 0; j < 3; ++j) {
    double steepness = 0;  // of local coordinate j, per cell
    for (int i = 0; i < 3; ++i) {
      const double v = inverse_[j][i] * double{cell[i]};
      steepness += v * v;
    }
    if (!(size[j] / std::sqrt(steepness) > 1e-6)) return true;
  }
  return false;
}

bool ReferencePart::inside_mesh(const double p[3]) const {
  int above = 0, below = 0;
  for (std::size_t k = 0; k < corner_.size(); k += 9) {
    const Meets m = meets(&corner_[k], &corner_[k + 3], &corner_[k + 6], p);
    above += m == Meets::above;
    below += m == Meets::below;
  }
  return above % 2 == 1 && below % 2 == 1;
}

bool ReferencePart::contains(const double p[3]) const {
  if (empty_) return false;
  if (by_facets_) return inside_mesh(p);
  double q[3];
  for (int j = 0; j < 3; ++j) {
    q[j] = 0;
    for (int i = 0; i < 3; ++i) q[j] += inverse_[j][i] * (p[i] - origin_[i]);
  }
  if (kind_ == MeshKind::sphere) return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] <= 0.25;
  if (!(std::abs(q[1]) <= 0.5)) return false;
  if (kind_ == MeshKind::box) return std::abs(q[0]) <= 0.5 && std::abs(q[2]) <= 0.5;
  const double r = 0.5 + 0.5 * (top_ - 1) * (q[1] + 0.5);
  return q[0] * q[0] + q[2] * q[2] <= r * r;
}

double ReferenceVolume::sample(int axis, std::int32_t i) const {
  const double low = double{grid_.min[axis]}, cell = (double{grid_.max[axis]} - low) / grid_.cells[axis];
  return low + (i + 0.5 + kSampleNudge[axis]) * cell;
}

ReferenceVolume::ReferenceVolume(const VoxelGrid& grid, const MeshTable& meshes, std::span<const Mesh> targets)
    : grid_(grid), meshes_(&meshes) {
  for (const Mesh& mesh : targets) {
    MeshRef ref;
    ref.kind = MeshKind::file;
    const ReferencePart part(ref, mesh, Instance{}, grid.cell_size());
    std::vector<bool> inside(grid.cell_count());
    visit(part, [&](std::int32_t x, std::int32_t y, std::int32_t z, bool in_grid) {
      if (in_grid) inside[grid_.index(std::uint32_t(x), std::uint32_t(y), std::uint32_t(z))] = true;
    });
    targets_.push_back(std::move(inside));
  }
}

/// Calls covered(x, y, z, in_grid) for every lattice point of the window inside the part.
template <class Visit>
void ReferenceVolume::visit(const ReferencePart& part, const Visit& covered) const {
  std::int32_t low[3], high[3], n[3];
  for (int i = 0; i < 3; ++i) {
    n[i] = static_cast<std::int32_t>(grid_.cells[i]);
    low[i] = -kWindowGrids * n[i];
    high[i] = (kWindowGrids + 1) * n[i];
    while (low[i] < high[i] && sample(i, low[i]) < part.low()[i]) ++low[i];
    while (low[i] < high[i] && sample(i, high[i] - 1) > part.high()[i]) --high[i];
  }
  for (std::int32_t z = low[2]; z < high[2]; ++z) {
    for (std::int32_t y = low[1]; y < high[1]; ++y) {
      for (std::int32_t x = low[0]; x < high[0]; ++x) {
        const double p[3] = {sample(0, x), sample(1, y), sample(2, z)};
        if (!part.contains(p)) continue;
        covered(x, y, z, x >= 0 && y >= 0 && z >= 0 && x < n[0] && y < n[1] && z < n[2]);
      }
    }
  }
}

std::vector<std::uint16_t> ReferenceVolume::cover(std::span<const Instance> instances, VolumeView view,
                                                  std::uint64_t& outside) const {
  std::vector<std::uint16_t> hits(grid_.cell_count());
  outside = 0;
  for (const Instance& instance : instances) {
    if (!shows(view, instance)) continue;
    const ReferencePart part(meshes_->ref(instance.mesh), meshes_->mesh(instance.mesh), instance, grid_.cell_size());
    visit(part, [&](std::int32_t x, std::int32_t y, std::int32_t z, bool in_grid) {
      if (in_grid) ++hits[grid_.index(std::uint32_t(x), std::uint32_t(y), std::uint32_t(z))];
      else ++outside;
    });
  }
  return hits;
}

VolumeCounts ReferenceVolume::counts(std::span<const Instance> instances, VolumeView view) const {
  VolumeCounts counts;
  counts.inside.assign(targets_.size(), 0);
  const std::vector<std::uint16_t> hits = cover(instances, view, counts.outside);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    counts.hits += hits[k];
    if (hits[k] == 0) continue;
    ++counts.covered;
    if (hits[k] > 1) ++counts.overlap;
    bool in_any = false;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      counts.inside[i] += targets_[i][k];
      in_any = in_any || targets_[i][k];
    }
    if (!in_any) ++counts.spilled;
  }
  return counts;
}

}  // namespace espalier
