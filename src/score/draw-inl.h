// Drawing spans into the canvas, tile by tile. A part wholly inside the grid is drawn plainly; others are also counted
// beyond it (kCounting). Included once per target.

#if defined(ESPALIER_SCORE_DRAW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_DRAW_INL_H
#undef ESPALIER_SCORE_DRAW_INL_H
#else
#define ESPALIER_SCORE_DRAW_INL_H
#endif

#include "score/spans-inl.h"
#include "score/voxel_canvas.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

HWY_INLINE std::int32_t tile_of(std::int32_t y) { return y >> 3; }  // floor(y / 8)

/// once |= mask, twice |= what was there already.
HWY_INLINE void put(const U8& mask, std::uint32_t* once, std::uint32_t* twice) {
  const U8 had = U8::load(once);
  (U8::load(twice) | (had & mask)).store(twice);
  (had | mask).store(once);
}

/// Where in the canvas one part goes, and what it has added up. Depths are integers here: F = 32 (top_word + 1) - z.
struct PartFrame {
  Reach reach;                         // window-clipped
  Reach grid;                          // grid-clipped
  std::int32_t top_word;               // of `reach`
  std::int32_t first_word, last_word;  // of `grid`; first > last if none
  I8 len_grid, len_window;             // voxels, per lane

  HWY_INLINE void set(const Reach& part, const VoxelCanvas& canvas) {
    reach = part;
    grid = part.in_grid(canvas.lattice);
    top_word = (reach.high[2] - 1) >> 5;
    first_word = grid.low[2] >> 5;
    last_word = grid.empty() ? first_word - 1 : (grid.high[2] - 1) >> 5;
    len_grid = len_window = I8::all(0);
  }
  /// For lanes outside [low, high) rows: a depth that empties the row; else `depth`.
  template <class Lanes, class Lane>
  static HWY_INLINE Lanes row_floor(std::int32_t tile, std::int32_t low, std::int32_t high, Lane depth, Lane never) {
    alignas(32) Lane lane[8];
    for (std::int32_t i = 0; i < 8; ++i) {
      const std::int32_t y = tile * 8 + i;
      lane[i] = y >= low && y < high ? depth : never;
    }
    return Lanes::load(lane);
  }
};

/// Puts the spans [high, low) of eight rows at one x into every word of the grid that they may touch.
template <bool kOneWord>
HWY_INLINE void put_spans(const I8& high, const I8& low, const PartFrame& part, std::size_t row, std::size_t word_stride,
                          VoxelCanvas& canvas) {
  std::uint32_t* once = canvas.once.data() + row;
  std::uint32_t* twice = canvas.twice.data() + row;
  if constexpr (kOneWord) {  // first_word == last_word == top_word
    put(low_bits_but(high) ^ low_bits_but(low), once, twice);
  } else {
    for (std::int32_t word = part.last_word; word >= part.first_word; --word) {
      const I8 skip = I8::all(32 * (part.top_word - word)), zero = I8::all(0);
      const U8 mask = low_bits_but(larger(high - skip, zero)) ^ low_bits_but(larger(low - skip, zero));
      const std::size_t at = static_cast<std::size_t>(word - part.first_word) * word_stride;
      put(mask, once + at, twice + at);
    }
  }
}

/// Calls rows(tile) for every tile row of eight that the part reaches, and keeps the sums.
template <class Rows>
HWY_INLINE void for_tiles(PartFrame& part, VoxelCanvas& canvas, const Rows& rows) {
  for (std::int32_t tile = tile_of(part.reach.low[1]); tile <= tile_of(part.reach.high[1] - 1); ++tile) {
    const bool in_grid = !part.grid.empty() && tile >= tile_of(part.grid.low[1]) &&
                         tile <= tile_of(part.grid.high[1] - 1);
    if (in_grid) {
      for (std::int32_t word = part.first_word; word <= part.last_word; ++word) {
        canvas.range(tile, word).add(part.grid.low[0], part.grid.high[0]);
      }
    }
    rows(tile, in_grid);
    canvas.hits += sum_of(part.len_grid);
    canvas.outside += sum_of(part.len_window) - sum_of(part.len_grid);
    part.len_grid = part.len_window = I8::all(0);
  }
}

/// A part inside the grid. `spans(x, high, low)` gives integer depths, clipped to the part's reach.
template <bool kOneWord, class Spans>
HWY_INLINE void draw_row_inside(PartFrame& part, VoxelCanvas& canvas, std::int32_t tile, Spans& spans) {
  std::size_t row = canvas.row_offset(tile, part.first_word) + static_cast<std::size_t>(part.grid.low[0]) * 8;
  const std::size_t stride = std::size_t{canvas.nx()} * 8;
  I8 sum = I8::all(0);
  for (std::int32_t x = part.grid.low[0]; x < part.grid.high[0]; ++x, row += 8) {
    I8 high, low;
    spans.next(high, low);
    sum = sum + (low - high);
    put_spans<kOneWord>(high, low, part, row, stride, canvas);
  }
  part.len_grid = part.len_window = sum;
}

/// A part that leaves the grid: counts all of it, draws what is inside.
template <class Spans>
HWY_INLINE void draw_row_counting(PartFrame& part, VoxelCanvas& canvas, std::int32_t tile, bool in_grid, Spans& spans) {
  const std::int32_t base = 32 * (part.top_word + 1);
  const I8 grid_low = I8::all(base);
  const I8 grid_high = PartFrame::row_floor<I8, std::int32_t>(tile, 0, canvas.lattice.cells[1],
                                                              base - canvas.lattice.cells[2], INT32_MAX / 2);
  const std::size_t stride = std::size_t{canvas.nx()} * 8;
  const std::size_t start = in_grid ? canvas.row_offset(tile, part.first_word) : 0;
  for (std::int32_t x = part.reach.low[0]; x < part.reach.high[0]; ++x) {
    I8 high, low;
    spans.next(high, low);
    part.len_window = part.len_window + (low - high);
    if (!in_grid || x < part.grid.low[0] || x >= part.grid.high[0]) continue;
    high = larger(high, grid_high);
    low = larger(smaller(low, grid_low), high);
    part.len_grid = part.len_grid + (low - high);
    put_spans<false>(high, low, part, start + static_cast<std::size_t>(x) * 8, stride, canvas);
  }
}

/// The spans of a form, x after x, as integer depths.
template <class Row, bool kLimited>
struct FormSpans {
  Row row;
  LimitRow limits;
  F8 x, f_top, f_bottom;

  HWY_INLINE FormSpans(const SpanForm& form, std::int32_t tile) {
    const std::int32_t first = tile * 8 - form.origin[1];
    row.set(form, lanes_from(static_cast<float>(first)));
    if constexpr (kLimited) limits.set(form, first);
    x = F8::all(static_cast<float>(form.reach.low[0] - form.origin[0]));
    f_top = PartFrame::row_floor<F8, float>(tile, form.reach.low[1], form.reach.high[1], form.f_top, kNever);
    f_bottom = F8::all(form.f_bottom);
  }
  HWY_INLINE void next(I8& high, I8& low) {
    Span span = row.at(x);
    if constexpr (kLimited) span.high = limits.apply(span.high, x);
    x = x + F8::all(1);
    const F8 f_high = larger(span.high, f_top);
    high = truncate(f_high);
    low = truncate(larger(smaller(span.low, f_bottom), f_high));
  }
};

template <class Row, bool kLimited>
HWY_NOINLINE void draw_form(const SpanForm& form, VoxelCanvas& canvas) {
  PartFrame part;
  part.set(form.reach, canvas);
  const bool inside = form.reach.inside(canvas.lattice);
  for_tiles(part, canvas, [&](std::int32_t tile, bool in_grid) HWY_ATTR {
    FormSpans<Row, kLimited> spans(form, tile);
    if (!inside) draw_row_counting(part, canvas, tile, in_grid, spans);
    else if (part.first_word == part.top_word) draw_row_inside<true>(part, canvas, tile, spans);
    else draw_row_inside<false>(part, canvas, tile, spans);
  });
}

template <class Row>
HWY_INLINE void draw_form_of(const SpanForm& form, VoxelCanvas& canvas) {
  form.limited() ? draw_form<Row, true>(form, canvas) : draw_form<Row, false>(form, canvas);
}

HWY_INLINE void draw(const SpanForm& form, VoxelCanvas& canvas) {
  switch (form.quadric) {
    case Quadric::sphere: return draw_form<SphereRow, false>(form, canvas);
    case Quadric::lens: return draw_form_of<RoundRow<Quadric::lens>>(form, canvas);
    case Quadric::up: return draw_form_of<RoundRow<Quadric::up>>(form, canvas);
    case Quadric::down: return draw_form_of<RoundRow<Quadric::down>>(form, canvas);
    case Quadric::none: break;
  }
  if (form.lowers + form.uppers > 0) return draw_form_of<PlaneRow>(form, canvas);
  if (form.slabs == 3) return draw_form<SlabRow<3>, false>(form, canvas);
  if (form.slabs == 2) return draw_form<SlabRow<2>, true>(form, canvas);
  draw_form<SlabRow<1>, true>(form, canvas);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
