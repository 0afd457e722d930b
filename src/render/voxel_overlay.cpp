#include "render/voxel_overlay.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"
#include "render/font.h"
#include "render/overlay.h"
#include "render/voxel_view.h"

namespace espalier {
namespace {

constexpr Colour kCutPaper{{255, 255, 255}}, kCutLine{{150, 155, 162}};

/// A cut across `w`: `u` runs to the right and `v` downwards, backwards where flipped.
struct Cut {
  int u, v, w;
  bool flip_u, flip_v;
  const char* from;
};
constexpr Cut kFront{0, 1, 2, false, true, "front"}, kRight{2, 1, 0, true, true, "right"},
    kAbove{0, 2, 1, false, false, "above"};

std::uint32_t cells_of(const MarkedVoxels& voxels, int axis) { return voxels.cells[static_cast<std::size_t>(axis)]; }

/// The cell that a pixel shows, of `pixels` that show all.
std::uint32_t cell_at(std::uint32_t pixel, std::uint32_t pixels, std::uint32_t cells, bool flip) {
  const auto cell = static_cast<std::uint32_t>(std::uint64_t{pixel} * cells / pixels);
  return flip ? cells - 1 - cell : cell;
}

Picture draw_cut(const MarkedVoxels& voxels, const Cut& cut, std::uint32_t plane, std::uint32_t width,
                 std::uint32_t height) {
  Picture picture = blank(width, height, kCutPaper);
  std::uint32_t at[3] = {plane, plane, plane};
  for (std::uint32_t y = 0; y < height; ++y) {
    at[cut.v] = cell_at(y, height, cells_of(voxels, cut.v), cut.flip_v);
    for (std::uint32_t x = 0; x < width; ++x) {
      at[cut.u] = cell_at(x, width, cells_of(voxels, cut.u), cut.flip_u);
      const std::size_t i = voxels.index(at[0], at[1], at[2]);
      if (voxels.mark(i) != VoxelMark::free) set_pixel(picture, x, y, colour_of(voxels.mark(i), voxels.twice(i)));
    }
  }
  return picture;
}

/// Ticks at the border where the other two cuts run.
void draw_ticks(Picture& sheet, std::uint32_t left, std::uint32_t top, std::uint32_t width, std::uint32_t height,
                const MarkedVoxels& voxels, const Cut& cut, const std::array<std::uint32_t, 3>& planes) {
  const auto place = [&](int axis, bool flip, std::uint32_t pixels) {
    const std::uint64_t cells = cells_of(voxels, axis), plane = planes[static_cast<std::size_t>(axis)];
    const std::uint64_t cell = flip ? cells - 1 - plane : plane;
    return static_cast<std::uint32_t>((2 * cell + 1) * pixels / (2 * cells));
  };
  const std::uint32_t x = left + place(cut.u, cut.flip_u, width), y = top + place(cut.v, cut.flip_v, height);
  fill_box(sheet, x, top - 7, 1, 6, kInk), fill_box(sheet, x, top + height + 1, 1, 6, kInk);
  fill_box(sheet, left - 7, y, 6, 1, kInk), fill_box(sheet, left + width + 1, y, 6, 1, kInk);
}

struct Layout {
  std::uint32_t x, y, z;           // pixels of the grid's sides
  std::uint32_t gap, label, scale;
  std::uint32_t view_width, view_height;
};

/// Cuts take a bit more than half of the width, and are no higher than the whole is wide.
Layout lay_out(const MarkedVoxels& voxels, std::uint32_t across) {
  const Vec3 size = voxels.max - voxels.min;
  Layout l{};
  l.scale = std::clamp(across / 480, 1u, 2u);
  l.gap = 12 * l.scale, l.label = (kCellHeight + 4) * l.scale;
  const auto room = static_cast<float>(across) * 0.52f;
  const float per_metre = std::min(room / (size.x + size.z), 1.2f * room / (size.y + size.z));
  const auto pixels = [&](float metres) { return std::max(8u, static_cast<std::uint32_t>(metres * per_metre + 0.5f)); };
  l.x = pixels(size.x), l.y = pixels(size.y), l.z = pixels(size.z);
  const std::uint32_t cuts = l.x + l.z + 3 * l.gap;
  l.view_width = across > cuts + 240 ? across - cuts : 240;
  l.view_height = std::max(l.y + l.z + l.gap + l.label, std::min(240u, l.view_width));
  return l;
}

}  // namespace

Colour colour_of(VoxelMark mark, bool twice) {
  switch (mark) {
    case VoxelMark::free: return kCutPaper;
    case VoxelMark::missed: return colour_of(Mark::missed);
    case VoxelMark::filled: return twice ? Colour{{10, 46, 96}} : colour_of(Mark::hit);
    case VoxelMark::spilled: return twice ? Colour{{122, 32, 6}} : colour_of(Mark::spilled);
    case VoxelMark::elsewhere: return twice ? Colour{{84, 88, 94}} : colour_of(Mark::covered);
    case VoxelMark::avoided: return colour_of(Mark::to_avoid);
    case VoxelMark::struck: return {{26, 26, 30}};
  }
  return kCutPaper;
}

std::array<std::uint32_t, 3> fullest_cuts(const MarkedVoxels& voxels) {
  std::vector<std::uint64_t> counts[3];
  for (int axis = 0; axis < 3; ++axis) counts[axis].resize(cells_of(voxels, axis));
  std::size_t i = 0;
  for (std::uint32_t z = 0; z < voxels.cells[2]; ++z) {
    for (std::uint32_t y = 0; y < voxels.cells[1]; ++y) {
      std::uint64_t row = 0;
      for (std::uint32_t x = 0; x < voxels.cells[0]; ++x, ++i) {
        const VoxelMark mark = voxels.mark(i);
        if (mark == VoxelMark::free || mark == VoxelMark::avoided) continue;
        ++counts[0][x], ++row;
      }
      counts[1][y] += row, counts[2][z] += row;
    }
  }
  std::array<std::uint32_t, 3> cuts;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cuts[axis] = static_cast<std::uint32_t>(std::max_element(counts[axis].begin(), counts[axis].end()) -
                                            counts[axis].begin());
  return cuts;
}

Picture draw_voxels(const MarkedVoxels& voxels, std::uint32_t across, std::uint32_t samples, Executor& executor) {
  CHECK(voxels.voxels.size() == std::size_t{voxels.cells[0]} * voxels.cells[1] * voxels.cells[2]);
  const Layout l = lay_out(voxels, across);
  const std::array<std::uint32_t, 3> planes = fullest_cuts(voxels);
  const std::uint32_t top_of_all = l.gap / 2 + l.label;
  Picture sheet = blank(l.view_width + l.x + l.z + 3 * l.gap, top_of_all + l.view_height + l.gap, kPaper);
  paste(sheet, voxel_view(voxels, l.view_width, l.view_height, samples, executor), 0, top_of_all);
  draw_text(sheet, l.gap, l.gap / 2, "from the right above", l.scale, kInk.rgb);
  const auto put = [&](const Cut& cut, std::uint32_t left, std::uint32_t top, std::uint32_t width,
                       std::uint32_t height) {
    const std::uint32_t plane = planes[static_cast<std::size_t>(cut.w)];
    paste(sheet, draw_cut(voxels, cut, plane, width, height), left, top);
    draw_frame(sheet, left, top, width, height, kCutLine);
    draw_ticks(sheet, left, top, width, height, voxels, cut, planes);
    const Vec3 cell = voxels.max - voxels.min;
    const float at = voxels.min[cut.w] + (static_cast<float>(plane) + 0.5f) * cell[cut.w] /
                                             static_cast<float>(cells_of(voxels, cut.w));
    const std::string full = fmt::format("{}, cut at {} = {:.3g}", cut.from, "xyz"[cut.w], at);
    const std::size_t cells = (width + l.gap) / (kCellWidth * l.scale);
    draw_text(sheet, left, top - l.label, full.size() <= cells ? full : fit_text(cut.from, cells), l.scale, kInk.rgb);
  };
  const std::uint32_t left = l.view_width + l.gap;
  put(kFront, left, top_of_all, l.x, l.y);
  put(kRight, left + l.x + l.gap, top_of_all, l.z, l.y);
  put(kAbove, left, top_of_all + l.y + l.gap + l.label, l.x, l.z);
  return sheet;
}

}  // namespace espalier
