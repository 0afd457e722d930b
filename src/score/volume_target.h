#pragma once
// The volume target: voxels of a model counted against meshes to fill or avoid. (ShapeGenetics 2017, section 8;
// Haubenwallner et al. 2016, section 3.1.6.)
//
// A voxel is *covered* when its centre lies inside a part. inside_i = covered voxels in target i, spilled = covered
// voxels in no target, overlap = voxels covered by two or more parts (each once; with OverlapCount::hits: hits minus one),
// outside = voxel centres of the same lattice beyond the grid, counted per part up to a stated bound.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "model/mesh.h"
#include "model/model.h"

namespace espalier {

/// A lattice of cubes or bricks. Cell (x, y, z) spans min + (x, y, z) * cell .. + cell; samples are taken at centres.
/// Linear order: x fastest, then y, then z (x + nx * (y + ny * z)).
struct VoxelGrid {
  Vec3 min{0};
  Vec3 max{1};
  std::uint32_t cells[3] = {1, 1, 1};

  Vec3 cell_size() const {
    return (max - min) / Vec3(static_cast<float>(cells[0]), static_cast<float>(cells[1]), static_cast<float>(cells[2]));
  }
  std::uint64_t cell_count() const { return std::uint64_t{cells[0]} * cells[1] * cells[2]; }
  std::uint64_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + std::uint64_t{cells[0]} * (y + std::uint64_t{cells[1]} * z);
  }
};

inline constexpr std::uint64_t kMostVoxels = 64'000'000;

/// The box around all targets plus 10 % of its size, cut into about `cells` cubes.
VoxelGrid default_grid(std::span<const Mesh> targets, std::uint64_t cells = 2'000'000);

enum class VolumeForm : std::uint8_t {
  linear,        // sum_i fill_i * inside_i + spill_i * (covered and outside voxels not in i)   - overlap * overlap_weight
  smootherstep,  // fill * S(inside / T) - spill * S((spilled + overlap + outside) / 2T)            (2016, eq. 2-6)
  smootherstep_separate,  // fill * S(inside / T) - spill * S((spilled + outside) / 3T) - overlap * S(overlap / covered)
};
enum class OverlapCount : std::uint8_t { voxels, hits };
enum class VolumeView : std::uint8_t { parts, full };

struct VolumeMesh {
  std::string name;   // for people
  Mesh mesh;          // in model space
  double fill = 1;    // per covered voxel inside; negative = avoid
  double spill = -1;  // linear: per covered voxel not inside. smootherstep: weight of what is wrong, subtracted
};

struct VolumeSettings {
  std::vector<VolumeMesh> meshes;
  VoxelGrid grid;
  VolumeForm form = VolumeForm::linear;
  VolumeView view = VolumeView::full;
  OverlapCount overlap_count = OverlapCount::voxels;
  double overlap_weight = 0;  // >= 0, subtracted
  /// linear: per voxel outside the grid, added; default (NaN): the sum of the spill weights, as in the paper.
  double outside_weight;
};

/// Exact counts for one model. All are numbers of voxels.
struct VolumeCounts {
  std::vector<std::uint64_t> inside;  // per target mesh
  std::uint64_t covered = 0;          // union of all parts, in the grid
  std::uint64_t spilled = 0;          // covered and in no target
  std::uint64_t overlap = 0;
  std::uint64_t outside = 0;
};

// Owned by the score room: VolumeTarget (kernel) and reference_counts (slow, obviously right) are declared in
// volume_kernel.h and volume_reference.h.

}  // namespace espalier
