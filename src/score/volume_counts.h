#pragma once
// VolumeCounts: what the voxel kernel and its slow reference count for one model, in one meaning.
//
// A voxel is *covered* when its centre (see kSampleNudge) lies inside a part. Parts are solids: flat things, parts
// thinner than a millionth of a cell, and parts whose frame is not finite cover nothing.

#include <cstdint>
#include <vector>

namespace espalier {

/// All are numbers of voxels; exact.
struct VolumeCounts {
  std::vector<std::uint64_t> inside;  // per target mesh: covered and in it
  std::uint64_t covered = 0;          // union of all parts, in the grid
  std::uint64_t spilled = 0;          // covered and in no target
  std::uint64_t overlap = 0;          // covered by two or more parts, each counted once
  std::uint64_t hits = 0;             // sum over parts of the voxels of the grid that each covers
  std::uint64_t outside = 0;          // per part: voxels beyond the grid, within kWindowGrids of it; summed over parts

  bool operator==(const VolumeCounts&) const = default;
};

}  // namespace espalier
