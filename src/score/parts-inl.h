// Drawing a model's parts: which way each goes. Included once per target.

#if defined(ESPALIER_SCORE_PARTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_PARTS_INL_H
#undef ESPALIER_SCORE_PARTS_INL_H
#else
#define ESPALIER_SCORE_PARTS_INL_H
#endif

#include <algorithm>
#include <bit>

#include "base/check.h"
#include "score/draw-inl.h"
#include "score/round_batch-inl.h"
#include "score/volume_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

/// Every lattice point of the reach: boxes along the axes, and the inside of huge parts.
template <class Canvas>
HWY_NOINLINE void draw_block(const Reach& reach, Canvas& canvas) {
  const Reach grid = reach.in_grid(canvas.lattice);
  const std::uint64_t in_grid = grid.volume();
  canvas.hits += in_grid;
  canvas.outside += reach.volume() - in_grid;
  if (in_grid == 0) return;
  const std::int32_t last = (grid.high[2] - 1) >> 5;
  for (std::int32_t tile = tile_of(grid.low[1]); tile <= tile_of(grid.high[1] - 1); ++tile) {
    const U8 rows = rows_between(tile, grid.low[1], grid.high[1]);
    for (std::int32_t word = grid.low[2] >> 5; word <= last; ++word) {
      const std::int32_t from = std::max(grid.low[2] - 32 * word, 0), to = std::min(grid.high[2] - 32 * word, 32);
      const U8 mask = rows & U8::all((~0u >> (32 - (to - from))) << from);
      canvas.mark(tile, word, grid.low[0], grid.high[0]);
      const std::size_t from_x = static_cast<std::size_t>(grid.low[0]) * Canvas::kTileWords;
      auto tiles = tiles_at(canvas, canvas.row_offset(tile, word) + from_x);
      for (std::int32_t x = grid.low[0]; x < grid.high[0]; ++x, tiles.next()) tiles.put(mask);
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

template <class Canvas>
HWY_NOINLINE void draw_columns(const ConvexShape& shape, Canvas& canvas) {
  if (shape.fills_reach()) return draw_block(shape.reach, canvas);
  const PartFrame part(shape.reach, canvas.lattice);
  for (std::int32_t tile = tile_of(part.reach.low[1]); tile <= tile_of(part.reach.high[1] - 1); ++tile) {
    ColumnSpans spans(shape, part, tile);
    draw_row_counting(part, canvas, tile, spans);
  }
}

/// One tile of scanned bits: into the planes where they lie in the grid, counted everywhere.
template <class Canvas>
HWY_INLINE void draw_scanned(const std::uint32_t* bits, const FacetScan& scan, std::int32_t tile, Canvas& canvas) {
  const Reach& reach = scan.reach();
  const Reach grid = reach.in_grid(canvas.lattice);
  const std::int32_t beyond = canvas.lattice.cells[2] % 32;
  const U8 rows = rows_between(tile, 0, canvas.lattice.cells[1]);
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
      tiles_at(canvas, canvas.row_offset(tile, word) + static_cast<std::size_t>(x) * Canvas::kTileWords).put(mask);
    }
  }
  canvas.hits += in_grid;
  canvas.outside += all - in_grid;
}

template <class Canvas>
HWY_NOINLINE void draw_facets(const Solid& solid, const GridPlacement& placement, FacetScan& scan, Canvas& canvas) {
  if (!scan.begin(solid.mesh, placement, canvas.lattice.low, canvas.lattice.high)) return;
  const Reach& reach = scan.reach();
  const Reach grid = reach.in_grid(canvas.lattice);
  for (std::int32_t tile = tile_of(reach.low[1]); tile <= tile_of(reach.high[1] - 1); ++tile) {
    if (!grid.empty() && tile >= 0 && tile < canvas.tile_rows()) {
      for (std::int32_t word = grid.low[2] >> 5; word <= (grid.high[2] - 1) >> 5; ++word) {
        canvas.mark(tile, word, grid.low[0], grid.high[0]);
      }
    }
    draw_scanned(scan.scan(tile), scan, tile, canvas);
  }
}

/// A convex part on its own, with all the care that it may need.
template <class Canvas>
HWY_NOINLINE void draw_convex(const Solid& solid, const Instance& instance, const GridPlacement& placement,
                              VolumeScratch& scratch, Canvas& canvas) {
  if (!scratch.shape.set(canvas.lattice, solid, placement, instance.top)) return;
  if (scratch.form.set(scratch.shape)) draw(scratch.form, canvas);
  else draw_columns(scratch.shape, canvas);
}

/// One part of a batch, as draw_form sees it.
template <int kBandCount>
class LaneForm {
 public:
  static constexpr int kBands = kBandCount;
  HWY_INLINE LaneForm(const PartBatch& batch, int lane) : batch_(&batch), lane_(lane) {
    for (int i = 0; i < 3; ++i) {
      reach_.low[i] = batch.reach(i, lane);
      reach_.high[i] = batch.reach(3 + i, lane);
    }
    for (int i = 0; i < 2; ++i) origin_[i] = batch.origin(i, lane);
  }
  HWY_INLINE const Reach& reach() const { return reach_; }
  HWY_INLINE std::int32_t origin(int axis) const { return origin_[axis]; }
  HWY_INLINE float f_top() const { return at(PartBatch::kTop); }
  HWY_INLINE float f_bottom() const { return at(PartBatch::kBottom); }
  HWY_INLINE LinearForm slab(int i) const { return linear(PartBatch::kSlab + 4 * i); }
  HWY_INLINE float width(int i) const { return at(PartBatch::kSlab + 4 * i + 3); }
  HWY_INLINE LinearForm middle() const { return linear(PartBatch::kMiddle); }
  HWY_INLINE LinearForm along() const { return linear(PartBatch::kAlong); }
  HWY_INLINE LinearForm across() const { return linear(PartBatch::kAcross); }
  HWY_INLINE LinearForm side() const { return {0, at(PartBatch::kSide), at(PartBatch::kSide + 1)}; }
  HWY_INLINE float most() const { return at(PartBatch::kMost); }
  HWY_INLINE Band band(int k) const {
    const int row = PartBatch::kBand + 3 * k;
    return {at(row), at(row + 1), at(row + 2)};
  }

 private:
  HWY_INLINE float at(int row) const { return batch_->value(row, lane_); }
  HWY_INLINE LinearForm linear(int row) const { return {at(row), at(row + 1), at(row + 2)}; }

  const PartBatch* batch_;
  int lane_;
  Reach reach_;
  std::int32_t origin_[2];
};

/// Parts of one kind, waiting until four have come together.
struct Waiting {
  const Instance* part[4];
  int count = 0;
};

template <class Canvas>
HWY_INLINE void draw_lane(const PartBatch& batch, int lane, SolidKind kind, Canvas& canvas) {
  if (kind == SolidKind::box) return draw_form<SlabRow<3>, false>(LaneForm<3>(batch, lane), canvas);
  if (kind == SolidKind::sphere) return draw_form<SphereRow, false>(LaneForm<1>(batch, lane), canvas);
  const LaneForm<2> form(batch, lane);
  if (batch.lens(lane)) return draw_form<RoundRow<Quadric::lens>, false>(form, canvas);
  if (batch.up(lane)) return draw_form<RoundRow<Quadric::up>, false>(form, canvas);
  draw_form<RoundRow<Quadric::down>, false>(form, canvas);
}

template <class Canvas>
HWY_NOINLINE void draw_batch(Waiting& waiting, const Solid& solid, VolumeScratch& scratch, Canvas& canvas) {
  if (waiting.count == 0) return;
  for (int lane = waiting.count; lane < 4; ++lane) waiting.part[lane] = waiting.part[0];
  PartBatch batch;
  batch.load(canvas.lattice, waiting.part);
  if (solid.kind == SolidKind::box) batch.set_boxes(canvas.lattice);
  else if (solid.kind == SolidKind::sphere) batch.set_spheres(canvas.lattice);
  else batch.set_rounds(canvas.lattice, waiting.part, solid.tapered);
  for (int lane = 0; lane < waiting.count; ++lane) {
    if (batch.ready(lane)) {
      if (!batch.empty(lane)) draw_lane(batch, lane, solid.kind, canvas);
      continue;
    }
    GridPlacement placement;
    if (place(canvas.lattice, waiting.part[lane]->model_from_mesh, placement)) {
      draw_convex(solid, *waiting.part[lane], placement, scratch, canvas);
    }
  }
  waiting.count = 0;
}

/// True if the part is a box along the axes, which is then drawn.
template <class Canvas>
HWY_INLINE bool draw_aligned(const Instance& instance, Canvas& canvas) {
  GridPlacement placement;
  if (!place(canvas.lattice, instance.model_from_mesh, placement)) return true;
  Reach reach;
  bool covers;
  if (!aligned_box(canvas.lattice, placement, reach, covers)) return false;
  if (covers && !reach.empty()) draw_block(reach, canvas);
  return true;
}

/// Draws the parts that the view shows. Neither their order nor their company matters to the planes and sums.
template <class Canvas>
HWY_INLINE void draw_parts(const std::vector<Solid>& solids, std::span<const Instance> instances, VolumeView view,
                           VolumeScratch& scratch, Canvas& canvas) {
  // Boxes, spheres, cylinders and cones wait here; solids of one of these kinds are all alike.
  constexpr int kKinds = 4;
  Waiting waiting[kKinds];
  const Solid* alike[kKinds] = {};
  for (const Instance& instance : instances) {
    if (!shows(view, instance)) continue;
    DCHECK(instance.mesh < solids.size());
    const Solid& solid = solids[instance.mesh];
    int slot = -1;
    switch (solid.kind) {
      case SolidKind::nothing: continue;
      case SolidKind::box:
        if (draw_aligned(instance, canvas)) continue;
        slot = 0;
        break;
      case SolidKind::sphere: slot = 1; break;
      case SolidKind::round: slot = solid.tapered ? 2 : 3; break;
      default: break;
    }
    if (slot >= 0) {
      alike[slot] = &solid;
      waiting[slot].part[waiting[slot].count++] = &instance;
      if (waiting[slot].count == 4) draw_batch(waiting[slot], solid, scratch, canvas);
      continue;
    }
    GridPlacement placement;
    if (!place(canvas.lattice, instance.model_from_mesh, placement)) continue;
    if (solid.kind == SolidKind::facets) draw_facets(solid, placement, scratch.scan, canvas);
    else draw_convex(solid, instance, placement, scratch, canvas);
  }
  for (int slot = 0; slot < kKinds; ++slot) {
    if (alike[slot] != nullptr) draw_batch(waiting[slot], *alike[slot], scratch, canvas);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
