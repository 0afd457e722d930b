#include "run/overlays.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/check.h"
#include "base/counted.h"

namespace espalier {
namespace {

constexpr std::size_t kMarks = static_cast<std::size_t>(Mark::to_avoid) + 1;
constexpr std::size_t kVoxelMarks = static_cast<std::size_t>(VoxelMark::struck) + 1;

std::uint8_t strength(std::int32_t degree) {
  return static_cast<std::uint8_t>((std::abs(degree) * 255 + WeightImage::kFull / 2) / WeightImage::kFull);
}

template <typename MarkOf>
MarkedPixels marked(const WeightImage& image, const MarkOf& mark_of) {
  MarkedPixels out{image.width, image.height, {}, {}};
  out.marks.reserve(image.degrees.size()), out.degrees.reserve(image.degrees.size());
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const std::int32_t degree = image.at(column, row);
      out.marks.push_back(mark_of(degree, column, row));
      out.degrees.push_back(strength(degree));
    }
  }
  return out;
}

/// "hit: 12345 pixels, 81.0 % of what is wanted"
std::string counted_share(const char* what, std::uint64_t count, const char* unit, std::uint64_t of,
                          const char* whole) {
  const std::string text = fmt::format("{}: {}", what, counted(count, unit));
  if (of == 0) return text;
  return text + fmt::format(", {:.1f} % of {}", 100 * static_cast<double>(count) / static_cast<double>(of), whole);
}

VoxelMark mark_of(bool covered, bool wanted, bool avoided, bool any_wanted) {
  if (wanted) return covered ? VoxelMark::filled : VoxelMark::missed;
  if (avoided) return covered ? VoxelMark::struck : VoxelMark::avoided;
  if (!covered) return VoxelMark::free;
  return any_wanted ? VoxelMark::spilled : VoxelMark::elsewhere;
}

/// The voxels of all meshes that are wanted, or that are to be avoided.
BitGrid united(const VolumeTarget& target, bool wanted) {
  const VoxelGrid& grid = target.grid();
  BitGrid bits(grid.cells[0], grid.cells[1], grid.cells[2]);
  for (std::size_t i = 0; i < target.settings().meshes.size(); ++i) {
    const double fill = target.settings().meshes[i].fill;
    if (wanted ? fill > 0 : fill < 0) unite(bits, target.voxels_of(i));
  }
  return bits;
}

}  // namespace

DrawingCounts count_drawing(const WeightImage& image) {
  DrawingCounts counts;
  for (const std::int32_t degree : image.degrees) {
    counts.wanted += degree > 0;
    counts.to_avoid += degree < 0;
    counts.indifferent += degree == 0;
  }
  return counts;
}

MarkedPixels mark_drawing(const WeightImage& image) {
  return marked(image, [](std::int32_t degree, std::uint32_t, std::uint32_t) {
    return degree > 0 ? Mark::wanted : degree < 0 ? Mark::to_avoid : Mark::indifferent;
  });
}

MarkedPixels mark_silhouette(const WeightImage& image, const PixelCanvas& silhouette) {
  CHECK(silhouette.width == image.width && silhouette.height == image.height);
  return marked(image, [&](std::int32_t degree, std::uint32_t column, std::uint32_t row) {
    const bool covered = silhouette.get(column, row);
    if (degree > 0) return covered ? Mark::hit : Mark::missed;
    if (degree < 0) return covered ? Mark::spilled : Mark::free;
    return covered ? Mark::covered : Mark::indifferent;
  });
}

MarkedPixels mark_silhouette(const SilhouetteTarget& target, std::span<const Instance> instances) {
  return mark_silhouette(target.settings().image, target.silhouette(instances));
}

MarkedVoxels mark_voxels(const VolumeTarget& target, std::span<const Instance> instances) {
  const VoxelGrid& grid = target.grid();
  MarkedVoxels out{{grid.cells[0], grid.cells[1], grid.cells[2]}, grid.min, grid.max, {}};
  out.voxels.reserve(grid.cell_count());
  const BitGrid wanted = united(target, true), avoided = united(target, false);
  const CoveredVoxels covered = target.covered(instances);
  const bool any_wanted = wanted.count() > 0;
  for (std::uint32_t z = 0; z < grid.cells[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.cells[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.cells[0]; ++x) {
        const VoxelMark mark =
            mark_of(covered.once.get(x, y, z), wanted.get(x, y, z), avoided.get(x, y, z), any_wanted);
        const int twice = covered.twice.get(x, y, z) ? MarkedVoxels::kTwice : 0;
        out.voxels.push_back(static_cast<std::uint8_t>(static_cast<int>(mark) | twice));
      }
    }
  }
  return out;
}

std::vector<LegendRow> legend_of_drawing(const DrawingCounts& counts) {
  const std::uint64_t all = counts.wanted + counts.to_avoid + counts.indifferent;
  std::vector<LegendRow> rows = {
      {{colour_of(Mark::wanted)}, counted_share("wanted", counts.wanted, "pixel", all, "all")},
      {{colour_of(Mark::to_avoid)}, counted_share("to be left free", counts.to_avoid, "pixel", all, "all")}};
  if (counts.indifferent > 0)
    rows.push_back({{colour_of(Mark::indifferent)},
                    counted_share("does not matter", counts.indifferent, "pixel", all, "all")});
  return rows;
}

std::vector<LegendRow> legend_of(const MarkedPixels& pixels) {
  std::array<std::uint64_t, kMarks> counts{};
  for (const Mark mark : pixels.marks) ++counts[static_cast<std::size_t>(mark)];
  const auto of = [&](Mark mark) { return counts[static_cast<std::size_t>(mark)]; };
  const std::uint64_t wanted = of(Mark::hit) + of(Mark::missed);
  const std::uint64_t all = of(Mark::hit) + of(Mark::spilled) + of(Mark::covered);
  std::vector<LegendRow> rows = {
      {{colour_of(Mark::hit)}, counted_share("hit", of(Mark::hit), "pixel", wanted, "what is wanted")},
      {{colour_of(Mark::missed)}, counted_share("missed", of(Mark::missed), "pixel", wanted, "what is wanted")},
      {{colour_of(Mark::spilled)}, counted_share("spilled", of(Mark::spilled), "pixel", all, "what is covered")}};
  if (of(Mark::covered) > 0)
    rows.push_back({{colour_of(Mark::covered)},
                    counted_share("covered, does not matter", of(Mark::covered), "pixel", all, "what is covered")});
  return rows;
}

std::vector<LegendRow> legend_of(const MarkedVoxels& voxels, std::uint64_t beyond) {
  std::array<std::uint64_t, kVoxelMarks> counts{};
  std::uint64_t twice = 0;
  for (std::size_t i = 0; i < voxels.voxels.size(); ++i) {
    ++counts[static_cast<std::size_t>(voxels.mark(i))];
    twice += voxels.twice(i);
  }
  const auto of = [&](VoxelMark mark) { return counts[static_cast<std::size_t>(mark)]; };
  const std::uint64_t wanted = of(VoxelMark::filled) + of(VoxelMark::missed);
  const std::uint64_t avoid = of(VoxelMark::struck) + of(VoxelMark::avoided);
  const std::uint64_t all =
      of(VoxelMark::filled) + of(VoxelMark::spilled) + of(VoxelMark::elsewhere) + of(VoxelMark::struck);
  std::vector<LegendRow> rows;
  const auto add = [&](VoxelMark mark, const char* what, std::uint64_t whole, const char* whole_name) {
    rows.push_back({{colour_of(mark)}, counted_share(what, of(mark), "voxel", whole, whole_name)});
  };
  if (wanted > 0) {
    add(VoxelMark::filled, "filled", wanted, "what is wanted");
    add(VoxelMark::missed, "missed", wanted, "what is wanted");
    add(VoxelMark::spilled, "spilled", all, "what is covered");
  } else {
    add(VoxelMark::elsewhere, "elsewhere", all, "what is covered");
  }
  if (avoid > 0) {
    add(VoxelMark::struck, "to be avoided, and hit", avoid, "what is to be avoided");
    add(VoxelMark::avoided, "to be avoided, and free", avoid, "what is to be avoided");
  }
  std::vector<Colour> dark;
  for (const VoxelMark mark : {VoxelMark::filled, VoxelMark::spilled, VoxelMark::elsewhere}) {
    if (wanted > 0 ? mark != VoxelMark::elsewhere : mark == VoxelMark::elsewhere) dark.push_back(colour_of(mark, true));
  }
  rows.push_back({dark, counted_share("overlap, by two parts or more", twice, "voxel", all, "what is covered")});
  if (beyond > 0) rows.push_back({{}, counted_share("not shown, beyond the grid", beyond, "voxel", 0, "")});
  return rows;
}

}  // namespace espalier
