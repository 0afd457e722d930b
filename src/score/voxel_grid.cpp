#include "score/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace espalier {

void validate(const VoxelGrid& grid, const char* name) {
  static constexpr char kAxis[] = "xyz";
  for (int i = 0; i < 3; ++i) {
    const bool finite = std::isfinite(grid.min[i]) && std::isfinite(grid.max[i]);
    if (!finite || !(grid.min[i] < grid.max[i])) {
      throw Error(fmt::format("{}: grid min must be below max along {}, got {} .. {}", name, kAxis[i], grid.min[i],
                              grid.max[i]));
    }
    if (grid.cells[i] < 1 || grid.cells[i] > kMostVoxelsPerAxis) {
      throw Error(fmt::format("{}: a grid has 1 to {} cells along {}, got {}", name, kMostVoxelsPerAxis, kAxis[i],
                              grid.cells[i]));
    }
  }
  if (grid.cell_count() > kMostVoxels) {
    throw Error(fmt::format("{}: a grid has at most {} voxels, got {}", name, kMostVoxels, grid.cell_count()));
  }
}

namespace {

/// Cubes of this size that cover the extents, each axis between 1 and the limit.
std::uint64_t count_cells(const double extent[3], double size, std::uint32_t cells[3]) {
  std::uint64_t total = 1;
  for (int i = 0; i < 3; ++i) {
    const double n = std::min(std::ceil(extent[i] / size), double{kMostVoxelsPerAxis});
    cells[i] = std::max(1u, static_cast<std::uint32_t>(n));
    total *= cells[i];
  }
  return total;
}

}  // namespace

VoxelGrid default_grid(std::span<const Mesh> targets, std::uint64_t cells) {
  Bounds box;
  for (const Mesh& mesh : targets) box.add(bounds(mesh));
  const Vec3 size = box.size();
  const double largest = box.empty() ? 0.0 : std::max({size.x, size.y, size.z});
  if (!(largest > 0) || !std::isfinite(largest)) {
    throw Error("volume: cannot choose a grid: the target meshes have no extent");
  }
  // Flat axes keep a little room, so that the box has a volume to divide.
  double extent[3];
  for (int i = 0; i < 3; ++i) extent[i] = 1.1 * std::max<double>(size[i], 0.01 * largest);
  const std::uint64_t wanted = std::clamp<std::uint64_t>(cells, 1, kMostVoxels);

  // The smallest cube that keeps the count at or below `wanted`, by bisection; 60 halvings exhaust a double.
  double low = largest / kMostVoxelsPerAxis, high = 2 * largest;
  VoxelGrid grid;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (count_cells(extent, middle, grid.cells) > wanted ? low : high) = middle;
  }
  count_cells(extent, high, grid.cells);
  for (int i = 0; i < 3; ++i) {
    const double half = 0.5 * high * grid.cells[i];
    const double centre = 0.5 * (double{box.min[i]} + double{box.max[i]});
    grid.min[i] = static_cast<float>(centre - half);
    grid.max[i] = static_cast<float>(centre + half);
  }
  return grid;
}

}  // namespace espalier
