// Drawing a model's parts: which way each goes. Included once per target.

#if defined(ESPALIER_SCORE_PARTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_PARTS_INL_H
#undef ESPALIER_SCORE_PARTS_INL_H
#else
#define ESPALIER_SCORE_PARTS_INL_H
#endif

#include <algorithm>
#include <bit>

#include "score/draw-inl.h"
#include "score/volume_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

/// Every lattice point of the reach: boxes along the axes, and the inside of huge parts.
HWY_NOINLINE void draw_block(const Reach& reach, VoxelCanvas& canvas) {
  const Reach grid = reach.in_grid(canvas.lattice);
  const std::uint64_t in_grid = grid.volume();
  canvas.hits += in_grid;
  canvas.outside += reach.volume() - in_grid;
  if (in_grid == 0) return;
  const std::int32_t last = (grid.high[2] - 1) >> 5;
  for (std::int32_t tile = tile_of(grid.low[1]); tile <= tile_of(grid.high[1] - 1); ++tile) {
    const U8 rows = PartFrame::row_floor<U8, std::uint32_t>(tile, grid.low[1], grid.high[1], ~0u, 0u);
    for (std::int32_t word = grid.low[2] >> 5; word <= last; ++word) {
      const std::int32_t from = std::max(grid.low[2] - 32 * word, 0), to = std::min(grid.high[2] - 32 * word, 32);
      const U8 mask = rows & U8::all((~0u >> (32 - (to - from))) << from);
      const std::size_t row = canvas.row_offset(tile, word);
      std::uint32_t* once = canvas.once.data() + row;
      std::uint32_t* twice = canvas.twice.data() + row;
      for (std::int32_t x = grid.low[0]; x < grid.high[0]; ++x) put(mask, once + x * 8, twice + x * 8);
      canvas.range(tile, word).add(grid.low[0], grid.high[0]);
    }
  }
}

/// Rows one by one in double precision, for shapes that floats cannot hold.
struct ColumnSpans {
  const ConvexShape* shape;
  std::int32_t base, x, y;  // base: depth 0

  HWY_INLINE ColumnSpans(const ConvexShape& of, const PartFrame& part, std::int32_t tile)
      : shape(&of), base(32 * (part.top_word + 1)), x(of.reach.low[0]), y(tile * 8) {}
  HWY_INLINE void next(I8& high, I8& low) {
    alignas(32) std::int32_t f_high[8], f_low[8];
    for (std::int32_t i = 0; i < 8; ++i) {
      f_high[i] = f_low[i] = 0;
      if (y + i < shape->reach.low[1] || y + i >= shape->reach.high[1]) continue;
      double from, to;
      shape->column(x - shape->origin[0], y + i - shape->origin[1], from, to);
      f_low[i] = base - ceil_clamped(from + shape->origin[2], shape->reach.low[2], shape->reach.high[2]);
      f_high[i] = base - ceil_clamped(to + shape->origin[2], shape->reach.low[2], shape->reach.high[2]);
      f_low[i] = std::max(f_low[i], f_high[i]);
    }
    ++x;
    high = I8::load(f_high);
    low = I8::load(f_low);
  }
};

HWY_NOINLINE void draw_columns(const ConvexShape& shape, VoxelCanvas& canvas) {
  if (shape.fills_reach()) return draw_block(shape.reach, canvas);
  PartFrame part;
  part.set(shape.reach, canvas);
  for_tiles(part, canvas, [&](std::int32_t tile, bool in_grid) HWY_ATTR {
    ColumnSpans spans(shape, part, tile);
    draw_row_counting(part, canvas, tile, in_grid, spans);
  });
}

/// One tile of scanned bits: into the planes where they lie in the grid, counted everywhere.
HWY_INLINE void draw_scanned(const std::uint32_t* bits, const FacetScan& scan, std::int32_t tile, VoxelCanvas& canvas) {
  const Reach& reach = scan.reach();
  const Reach grid = reach.in_grid(canvas.lattice);
  const std::int32_t beyond = canvas.lattice.cells[2] % 32;
  const U8 rows = PartFrame::row_floor<U8, std::uint32_t>(tile, 0, canvas.lattice.cells[1], ~0u, 0u);
  std::uint64_t all = 0, in_grid = 0;
  for (std::int32_t x = reach.low[0]; x < reach.high[0]; ++x) {
    for (std::int32_t w = 0; w < scan.words(); ++w, bits += 8) {
      for (int i = 0; i < 8; ++i) all += static_cast<std::uint64_t>(std::popcount(bits[i]));
      const std::int32_t word = scan.first_word() + w;
      if (grid.empty() || x < grid.low[0] || x >= grid.high[0] || word < 0 || word >= canvas.depth()) continue;
      if (tile < 0 || tile >= canvas.tile_rows()) continue;
      const bool last = beyond > 0 && word == canvas.depth() - 1;
      const U8 mask = U8::load(bits) & rows & U8::all(last ? (1u << beyond) - 1 : ~0u);
      alignas(32) std::uint32_t lane[8];
      mask.store(lane);
      for (const std::uint32_t v : lane) in_grid += static_cast<std::uint64_t>(std::popcount(v));
      const std::size_t at = canvas.row_offset(tile, word) + static_cast<std::size_t>(x) * 8;
      put(mask, canvas.once.data() + at, canvas.twice.data() + at);
    }
  }
  canvas.hits += in_grid;
  canvas.outside += all - in_grid;
}

HWY_NOINLINE void draw_facets(const Solid& solid, const Placement& placement, VolumeScratch& scratch) {
  FacetScan& scan = scratch.scan;
  VoxelCanvas& canvas = scratch.canvas;
  if (!scan.begin(solid.mesh, placement, canvas.lattice.low, canvas.lattice.high)) return;
  const Reach& reach = scan.reach();
  const Reach grid = reach.in_grid(canvas.lattice);
  for (std::int32_t tile = tile_of(reach.low[1]); tile <= tile_of(reach.high[1] - 1); ++tile) {
    if (!grid.empty() && tile >= 0 && tile < canvas.tile_rows()) {
      for (std::int32_t word = grid.low[2] >> 5; word <= (grid.high[2] - 1) >> 5; ++word) {
        canvas.range(tile, word).add(grid.low[0], grid.high[0]);
      }
    }
    draw_scanned(scan.scan(tile), scan, tile, canvas);
  }
}

HWY_INLINE void draw_part(const Solid& solid, const Instance& instance, VolumeScratch& scratch) {
  if (solid.kind == SolidKind::nothing) return;
  VoxelCanvas& canvas = scratch.canvas;
  Placement placement;
  if (!place(canvas.lattice, instance.model_from_mesh, placement)) return;
  if (solid.kind == SolidKind::facets) return draw_facets(solid, placement, scratch);
  if (solid.kind == SolidKind::box) {
    Reach reach;
    bool covers;
    if (aligned_box(canvas.lattice, placement, reach, covers)) {
      if (covers && !reach.empty()) draw_block(reach, canvas);
      return;
    }
  }
  if (!scratch.shape.set(canvas.lattice, solid, placement, instance.top)) return;
  if (scratch.form.set(scratch.shape)) draw(scratch.form, canvas);
  else draw_columns(scratch.shape, canvas);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
