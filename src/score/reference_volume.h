#pragma once
// ReferenceVolume: what the volume kernel must count, by asking every voxel centre of every part whether it is inside.
// Slow and plain on purpose; double precision, exact shapes, no code shared with the kernel. For tests and benchmarks.

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "score/volume_counts.h"
#include "score/volume_view.h"
#include "score/voxel_grid.h"

namespace espalier {

/// One placed part.
class ReferencePart {
 public:
  /// `cell` is the cell size of the grid, needed to tell what is flat.
  ReferencePart(const MeshRef& ref, const Mesh& mesh, const Instance& instance, const Vec3& cell);

  /// Is the point, in model space, inside?
  bool contains(const double p[3]) const;
  /// A box around the part in model space; empty (low > high) if it covers nothing.
  const double* low() const { return low_; }
  const double* high() const { return high_; }

 private:
  void place(const Frame& frame);
  bool finite() const;
  bool flat(const Vec3& cell, const double size[3]) const;
  void set_box(const Bounds& box, double wide);
  void set_corners();
  bool inside_mesh(const double p[3]) const;

  MeshKind kind_;
  bool by_facets_ = false, empty_ = true;
  double top_ = 1;
  double basis_[3][3], origin_[3], inverse_[3][3];
  double low_[3], high_[3];
  Mesh mesh_;
  std::vector<double> corner_;  // model space, 9 per triangle
};

class ReferenceVolume {
 public:
  ReferenceVolume(const VoxelGrid& grid, const MeshTable& meshes, std::span<const Mesh> targets);

  /// Parts that cover each voxel (index: VoxelGrid::index), and the voxels that they cover beyond the grid.
  std::vector<std::uint16_t> cover(std::span<const Instance> instances, VolumeView view, std::uint64_t& outside) const;
  VolumeCounts counts(std::span<const Instance> instances, VolumeView view) const;
  /// Target i covers voxel k.
  const std::vector<std::vector<bool>>& targets() const { return targets_; }

  /// Where voxel `i` of an axis is sampled, in model space; i may lie beyond the grid.
  double sample(int axis, std::int32_t i) const;

 private:
  template <class Visit>
  void visit(const ReferencePart& part, const Visit& covered) const;

  VoxelGrid grid_;
  const MeshTable* meshes_;
  std::vector<std::vector<bool>> targets_;
};

}  // namespace espalier
