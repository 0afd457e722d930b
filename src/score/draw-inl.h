// Drawing spans into a canvas (plain or counting), tile by tile. A part wholly inside the grid is drawn plainly; others
// are also counted beyond it. Included once per target.

#if defined(ESPALIER_SCORE_DRAW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_DRAW_INL_H
#undef ESPALIER_SCORE_DRAW_INL_H
#else
#define ESPALIER_SCORE_DRAW_INL_H
#endif

#include <algorithm>

#include "score/counting_canvas.h"
#include "score/spans-inl.h"
#include "score/voxel_canvas.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

HWY_INLINE std::int32_t tile_of(std::int32_t y) { return y >> 3; }  // floor(y / 8)

/// All bits set in the lanes whose row lies in [low, high).
HWY_INLINE U8 rows_between(std::int32_t tile, std::int32_t low, std::int32_t high) {
  static constexpr std::uint32_t kEdge[24] = {0, 0, 0, 0, 0, 0, 0, 0, ~0u, ~0u, ~0u, ~0u, ~0u, ~0u, ~0u, ~0u, 0, 0, 0,
                                              0, 0, 0, 0, 0};
  const std::int32_t from = std::clamp(low - tile * 8, 0, 8), to = std::clamp(high - tile * 8, 0, 8);
  return U8::load_anywhere(kEdge + 8 - from) & U8::load_anywhere(kEdge + 16 - to);
}

/// Tiles of a plain canvas, one after the other: once |= mask, twice |= what was there already. `ahead` is in words of
/// the canvas's tiles.
struct PlainTiles {
  std::uint32_t *once, *twice;

  HWY_INLINE PlainTiles(VoxelCanvas& canvas, std::size_t at)
      : once(canvas.once.data() + at), twice(canvas.twice.data() + at) {}
  HWY_INLINE void put(const U8& mask, std::ptrdiff_t ahead = 0) const {
    const U8 had = U8::load(once + ahead);
    (U8::load(twice + ahead) | (had & mask)).store(twice + ahead);
    (had | mask).store(once + ahead);
  }
  HWY_INLINE void next() { once += VoxelCanvas::kTileWords, twice += VoxelCanvas::kTileWords; }
};

/// Tiles of a counting canvas: counts up or down where the mask is set.
struct CountTiles {
  std::uint32_t *at, *overflow;
  U8 flip;  // all bits: down

  HWY_INLINE CountTiles(CountingCanvas& canvas, std::size_t offset)
      : at(canvas.planes.data() + offset), overflow(canvas.overflow), flip(U8::all(canvas.down ? ~0u : 0)) {}
  HWY_INLINE void put(const U8& mask, std::ptrdiff_t ahead = 0) const {
    U8 carry = mask;
    for (std::size_t plane = 0; plane < kCountPlanes; ++plane) {
      std::uint32_t* words = at + ahead + plane * 8;
      const U8 had = U8::load(words);
      (had ^ carry).store(words);
      carry = carry & (had ^ flip);
    }
    (U8::load(overflow) | carry).store(overflow);
  }
  HWY_INLINE void next() { at += CountingCanvas::kTileWords; }
};

HWY_INLINE PlainTiles tiles_at(VoxelCanvas& canvas, std::size_t at) { return PlainTiles(canvas, at); }
HWY_INLINE CountTiles tiles_at(CountingCanvas& canvas, std::size_t at) { return CountTiles(canvas, at); }

/// Where in the canvas one part goes. Depths are integers here: F = 32 (top_word + 1) - z.
struct PartFrame {
  Reach reach;                         // clipped to the window
  Reach grid;                          // clipped to the grid
  std::int32_t top_word;               // of `reach`
  std::int32_t first_word, last_word;  // of `grid`; first > last if none

  HWY_INLINE PartFrame(const Reach& part, const Lattice& lattice) : reach(part), grid(part.in_grid(lattice)) {
    top_word = (reach.high[2] - 1) >> 5;
    first_word = grid.low[2] >> 5;
    last_word = grid.empty() ? first_word - 1 : (grid.high[2] - 1) >> 5;
  }
  HWY_INLINE bool in_grid(std::int32_t tile) const {
    return !grid.empty() && tile >= tile_of(grid.low[1]) && tile <= tile_of(grid.high[1] - 1);
  }
  template <class Canvas>
  HWY_INLINE void mark(Canvas& canvas, std::int32_t tile, std::int32_t from, std::int32_t to) const {
    for (std::int32_t word = first_word; word <= last_word; ++word) canvas.mark(tile, word, from, to);
  }
};

/// The bits of word `words_down` words below the part's top word that the spans [high, low) cover.
HWY_INLINE U8 bits_of(const I8& high, const I8& low, std::int32_t words_down) {
  const I8 skip = I8::all(32 * words_down), zero = I8::all(0);
  return low_bits_but(larger(high - skip, zero)) ^ low_bits_but(larger(low - skip, zero));
}

/// A tile row of a part inside the grid: `count` tiles from `tiles` on, which begin in the row of the top word; the
/// part's other words lie `stride` lower each. kWords = 0: any number. Returns the voxels per lane.
template <int kWords, class Tiles, class Spans>
HWY_INLINE I8 draw_row_inside(Tiles tiles, std::int32_t count, std::ptrdiff_t stride, std::int32_t words,
                              Spans& spans) {
  I8 sum = I8::all(0);
  for (; count > 0; --count, tiles.next()) {
    I8 high, low;
    spans.next(high, low);
    sum = sum - high + low;
    tiles.put(low_bits_but(high) ^ low_bits_but(low));
    if constexpr (kWords == 2) tiles.put(bits_of(high, low, 1), -stride);
    if constexpr (kWords == 0) {
      for (std::int32_t word = 1; word < words; ++word) tiles.put(bits_of(high, low, word), -word * stride);
    }
  }
  return sum;
}

/// A tile row of a part that leaves the grid: counts all of it, draws what is inside.
template <class Canvas, class Spans>
HWY_INLINE void draw_row_counting(const PartFrame& part, Canvas& canvas, std::int32_t tile, Spans& spans) {
  const std::int32_t base = 32 * (part.top_word + 1);
  const U8 rows = rows_between(tile, 0, canvas.lattice.cells[1]);
  const I8 grid_low = I8::all(base);  // z = 0
  const I8 grid_high = choose(to_int(rows), I8::all(base - canvas.lattice.cells[2]), I8::all(INT32_MAX / 2));
  const bool in_grid = part.in_grid(tile);
  const std::size_t start = in_grid ? canvas.row_offset(tile, part.first_word) : 0;
  if (in_grid) part.mark(canvas, tile, part.grid.low[0], part.grid.high[0]);
  I8 len_window = I8::all(0), len_grid = I8::all(0);
  for (std::int32_t x = part.reach.low[0]; x < part.reach.high[0]; ++x) {
    I8 high, low;
    spans.next(high, low);
    len_window = len_window + (low - high);
    if (!in_grid || x < part.grid.low[0] || x >= part.grid.high[0]) continue;
    high = larger(high, grid_high);
    low = larger(smaller(low, grid_low), high);
    len_grid = len_grid + (low - high);
    std::size_t at = start + static_cast<std::size_t>(x) * Canvas::kTileWords;
    for (std::int32_t word = part.first_word; word <= part.last_word; ++word, at += canvas.row_words()) {
      tiles_at(canvas, at).put(bits_of(high, low, part.top_word - word));
    }
  }
  canvas.hits += sum_of(len_grid);
  canvas.outside += sum_of(len_window) - sum_of(len_grid);
}

/// The spans of a form, x after x, as integer depths.
template <class Row, bool kLimited>
struct FormSpans {
  Row row;
  LimitRow limits;
  F8 x, f_top, f_bottom;

  template <class Form>
  HWY_INLINE FormSpans(const Form& form, std::int32_t tile, std::int32_t from) {
    const std::int32_t first = tile * 8 - form.origin(1);
    row.set(form, lanes_from(static_cast<float>(first)));
    if constexpr (kLimited) limits.set(form, first);
    x = F8::all(static_cast<float>(from - form.origin(0)));
    const U8 rows = rows_between(tile, form.reach().low[1], form.reach().high[1]);
    f_top = choose(to_float(rows), F8::all(form.f_top()), F8::all(kNever));
    f_bottom = F8::all(form.f_bottom());
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

/// The x that a tile row of the part may cover: its reach, narrowed by the bands.
template <class Form>
HWY_INLINE void narrow(const Form& form, std::int32_t tile, std::int32_t& from, std::int32_t& to) {
  const std::int32_t ox = form.origin(0);
  float low = static_cast<float>(form.reach().low[0] - ox), high = static_cast<float>(form.reach().high[0] - 1 - ox);
  const float y = static_cast<float>(tile * 8 - form.origin(1));
  for (int k = 0; k < Form::kBands; ++k) {
    const Band band = form.band(k);
    low = std::max(low, band.slope * y + band.low);
    high = std::min(high, band.slope * y + band.high);
  }
  from = ox + static_cast<std::int32_t>(std::min(low, 1e6f));
  to = ox + static_cast<std::int32_t>(std::max(high, -1e6f)) + 1;
  if (low > high) to = from;
}

template <class Row, bool kLimited, class Form, class Canvas>
HWY_NOINLINE void draw_leaving(const Form& form, Canvas& canvas) {
  const PartFrame part(form.reach(), canvas.lattice);
  for (std::int32_t tile = tile_of(part.reach.low[1]); tile <= tile_of(part.reach.high[1] - 1); ++tile) {
    FormSpans<Row, kLimited> spans(form, tile, part.reach.low[0]);
    draw_row_counting(part, canvas, tile, spans);
  }
}

template <class Row, bool kLimited, class Form, class Canvas>
HWY_NOINLINE void draw_form(const Form& form, Canvas& canvas) {
  const Reach& reach = form.reach();
  if (!reach.inside(canvas.lattice)) return draw_leaving<Row, kLimited>(form, canvas);
  const std::int32_t first_word = reach.low[2] >> 5, last_word = (reach.high[2] - 1) >> 5;
  const std::int32_t words = last_word - first_word + 1;
  const auto stride = static_cast<std::ptrdiff_t>(canvas.row_words());
  I8 sum = I8::all(0);
  for (std::int32_t tile = tile_of(reach.low[1]); tile <= tile_of(reach.high[1] - 1); ++tile) {
    std::int32_t from, to;
    narrow(form, tile, from, to);
    if (from >= to) continue;
    for (std::int32_t word = first_word; word <= last_word; ++word) canvas.mark(tile, word, from, to);
    FormSpans<Row, kLimited> spans(form, tile, from);
    const std::size_t at = canvas.row_offset(tile, last_word) + static_cast<std::size_t>(from) * Canvas::kTileWords;
    const auto tiles = tiles_at(canvas, at);
    if (words == 1) sum = sum + draw_row_inside<1>(tiles, to - from, stride, 1, spans);
    else if (words == 2) sum = sum + draw_row_inside<2>(tiles, to - from, stride, 2, spans);
    else sum = sum + draw_row_inside<0>(tiles, to - from, stride, words, spans);
  }
  canvas.hits += sum_of(sum);
}

template <class Row, class Canvas>
HWY_INLINE void draw_form_of(const SpanForm& form, Canvas& canvas) {
  form.limited() ? draw_form<Row, true>(form, canvas) : draw_form<Row, false>(form, canvas);
}

template <class Canvas>
HWY_INLINE void draw(const SpanForm& form, Canvas& canvas) {
  switch (form.quadric()) {
    case Quadric::sphere: return draw_form<SphereRow, false>(form, canvas);
    case Quadric::lens: return draw_form_of<RoundRow<Quadric::lens>>(form, canvas);
    case Quadric::up: return draw_form_of<RoundRow<Quadric::up>>(form, canvas);
    case Quadric::down: return draw_form_of<RoundRow<Quadric::down>>(form, canvas);
    case Quadric::none: break;
  }
  if (form.lowers() + form.uppers() > 0) return draw_form_of<PlaneRow>(form, canvas);
  if (form.slabs() == 3) return draw_form_of<SlabRow<3>>(form, canvas);
  if (form.slabs() == 2) return draw_form_of<SlabRow<2>>(form, canvas);
  draw_form_of<SlabRow<1>>(form, canvas);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
