// Drawing outlines into a canvas of pixels and weighing what is covered, eight rows at a time. Included once per
// target.

#if defined(ESPALIER_SCORE_SILHOUETTE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_SILHOUETTE_INL_H
#undef ESPALIER_SCORE_SILHOUETTE_INL_H
#else
#define ESPALIER_SCORE_SILHOUETTE_INL_H
#endif

#include <algorithm>
#include <bit>

#include "score/bit_sum-inl.h"
#include "score/outline.h"
#include "score/outline_batch-inl.h"
#include "score/silhouette_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

inline constexpr float kNowhere = 1e9f;  // still an int

/// The least and greatest column of eight rows.
struct RowSpans {
  F8 low, high;

  HWY_INLINE RowSpans() : low(F8::all(kNowhere)), high(F8::all(-kNowhere)) {}
  // Sums keep rows outside a piece away: blending takes longer.
  HWY_INLINE void add(const OutlineEdge& edge, const F8& y) {
    const F8 from = F8::all(edge.y_low), at = smaller(larger(y, from), F8::all(edge.y_high));
    const F8 x = F8::all(edge.x) + F8::all(edge.slope) * (at - from), away = different(at, y) & F8::all(kNowhere);
    low = smaller(low, x + away);
    high = larger(high, x - away);
  }
  HWY_INLINE void add(const OutlineEllipse& e, const F8& y) {
    const F8 one = F8::all(1), t = (y - F8::all(e.y)) * F8::all(e.per_half_height);
    const F8 at = smaller(larger(t, -one), one), away = different(at, t) & F8::all(kNowhere);
    const F8 half = F8::all(e.half_width) * square_root(one - at * at) - away;
    const F8 middle = F8::all(e.x) + F8::all(e.lean) * at;
    low = smaller(low, middle - half);
    high = larger(high, middle + half);
  }
};

HWY_INLINE I8 column_from(const F8& x, std::int32_t origin, std::int32_t least, std::int32_t most) {
  // Relative to the part, so that single precision does not tell on the far side of an image.
  const I8 column = truncate(rounded_up(x - F8::all(0.5f))) + I8::all(origin);
  return smaller(larger(column, I8::all(least)), I8::all(most));
}

/// Where a part may be: pixels of the image, half-open, and what its pieces count from.
struct SpanBox {
  std::int32_t origin[2], column[2], row[2];
};

/// Sets the pixels whose middles lie between the pieces' least and greatest columns; `add(first, last, y, spans)` adds
/// what lies between two rows.
template <class AddPieces>
HWY_INLINE void draw_spans(const SpanBox& box, PixelCanvas& canvas, const AddPieces& add) {
  const std::int32_t first_word = box.column[0] >> 5, last_word = (box.column[1] - 1) >> 5;
  const std::int32_t origin = box.origin[0] - 32 * first_word, least = box.column[0] - 32 * first_word,
                     most = box.column[1] - 32 * first_word;
  const std::int32_t first_tile = box.row[0] >> 3, last_tile = (box.row[1] - 1) >> 3;
  const std::size_t stride = std::size_t{canvas.across} * 8;
  std::uint32_t* row_words = canvas.words.data() + static_cast<std::size_t>(first_tile) * stride +
                             static_cast<std::size_t>(first_word) * 8;
  for (std::int32_t tile = first_tile; tile <= last_tile; ++tile, row_words += stride) {
    const float first = static_cast<float>(tile * 8 - box.origin[1]), last = first + 8;
    F8 y = lanes_from(first + 0.5f);
    if (static_cast<std::uint32_t>(tile * 8 + 8) > canvas.height) {  // rows below the image stay empty
      const F8 below = F8::all(static_cast<float>(box.row[1] - box.origin[1]));
      y = choose(less(y, below), y, F8::all(kNowhere));
    }
    RowSpans spans;
    add(first, last, y, spans);
    I8 low = column_from(spans.low, origin, least, most);
    I8 high = larger(column_from(spans.high, origin, least, most), low);
    std::uint32_t* words = row_words;
    (U8::load(words) | (low_bits_but(low) ^ low_bits_but(high))).store(words);
    for (std::int32_t word = first_word; word < last_word; ++word) {
      words += 8;
      const I8 zero = I8::all(0), wide = I8::all(32);
      low = larger(low - wide, zero), high = larger(high - wide, zero);
      (U8::load(words) | (low_bits_but(low) ^ low_bits_but(high))).store(words);
    }
  }
}

HWY_INLINE void draw_outline(const Outline& outline, PixelCanvas& canvas) {
  const SpanBox box{{outline.origin[0], outline.origin[1]}, {outline.column[0], outline.column[1]},
                    {outline.row[0], outline.row[1]}};
  draw_spans(box, canvas, [&](float first, float last, const F8& y, RowSpans& spans) {
    for (const OutlineEdge& edge : outline.edges)
      if (edge.y_low < last && edge.y_high > first) spans.add(edge, y);
    for (const OutlineEllipse& ellipse : outline.ellipses)
      if (ellipse.y_low < last && ellipse.y_high > first) spans.add(ellipse, y);
  });
}

HWY_INLINE OutlineEdge edge_of(const OutlineBatch& b, int index, int lane) {
  const float(&e)[4][8] = b.edges_[index];
  return {e[0][lane], e[1][lane], e[2][lane], e[3][lane]};
}
HWY_INLINE OutlineEllipse ellipse_of(const OutlineBatch& b, int index, int lane) {
  const float(&e)[5][8] = b.ellipses_[index];
  return {e[0][lane], e[1][lane], e[2][lane], e[3][lane], e[4][lane], 0, 0};
}

/// A box of which three faces are seen: six lines, in the rows that it reaches.
HWY_INLINE void draw_hexagon(const OutlineBatch& b, int lane, const SpanBox& box, PixelCanvas& canvas) {
  const F8 first_row = F8::all(static_cast<float>(box.row[0] - box.origin[1]) + 0.5f),
           last_row = F8::all(static_cast<float>(box.row[1] - box.origin[1]) - 0.5f);
  draw_spans(box, canvas, [&](float, float, const F8& y, RowSpans& spans) {
    F8 low = F8::all(-kNowhere), high = F8::all(kNowhere);
    for (int i = 0; i < 6; ++i) {
      const float(&line)[3][8] = b.lines_[i];
      const F8 x = F8::all(line[0][lane]) * y;
      low = larger(low, x + F8::all(line[1][lane]));
      high = smaller(high, x + F8::all(line[2][lane]));
    }
    const F8 at = smaller(larger(y, first_row), last_row);
    spans.low = low;
    spans.high = choose(different(at, y), F8::all(-kNowhere), high);
  });
}

/// One part of a batch. Balls and cones work out all pieces in all tiles, so that there are no jumps to guess wrong.
HWY_INLINE void draw_lane(const OutlineBatch& b, BatchKind kind, int lane, PixelCanvas& canvas) {
  const SpanBox box{{b.origin_[0][lane], b.origin_[1][lane]}, {b.column_[0][lane], b.column_[1][lane]},
                    {b.row_[0][lane], b.row_[1][lane]}};
  if (box.column[0] >= box.column[1] || box.row[0] >= box.row[1]) return;
  switch (kind) {
    case BatchKind::sphere:
      draw_spans(box, canvas,
                 [&](float, float, const F8& y, RowSpans& spans) { spans.add(ellipse_of(b, 0, lane), y); });
      break;
    case BatchKind::round:
      draw_spans(box, canvas, [&](float, float, const F8& y, RowSpans& spans) {
        spans.add(edge_of(b, 0, lane), y), spans.add(edge_of(b, 1, lane), y);
        spans.add(ellipse_of(b, 0, lane), y), spans.add(ellipse_of(b, 1, lane), y);
      });
      break;
    case BatchKind::box:
      if (b.hexagon_[lane] != 0) return draw_hexagon(b, lane, box, canvas);
      draw_spans(box, canvas, [&](float first, float last, const F8& y, RowSpans& spans) {
        for (std::uint32_t left = b.kept_[lane]; left != 0; left &= left - 1) {
          const OutlineEdge edge = edge_of(b, std::countr_zero(left), lane);
          if (edge.y_low < last && edge.y_high > first) spans.add(edge, y);
        }
      });
      break;
  }
}

HWY_INLINE U8 population(const U8& a) {
  U8 r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::PopulationCount(a.block[i]);
  return r;
}

HWY_INLINE std::uint64_t total(const U8& a) {
  alignas(32) std::uint32_t lane[8];
  a.store(lane);
  std::uint64_t sum = 0;
  for (const std::uint32_t v : lane) sum += v;
  return sum;
}

HWY_INLINE bool any(const U8& a) {
  alignas(32) std::uint32_t lane[8];
  a.store(lane);
  std::uint32_t all = 0;
  for (const std::uint32_t v : lane) all |= v;
  return all != 0;
}

/// The degrees of the pixels of one tile that `bits` names; at most 256 * 65535.
HWY_INLINE std::uint64_t weigh(const U8& bits, const std::int32_t* degrees) {
  I8 sum = I8::all(0);
  const I8 zero = I8::all(0);
  U8 left = bits;
  for (int column = 0; column < 32; ++column, degrees += 8) {
    // The highest bit of a lane is its sign, and the next column is shifted there.
    sum = sum + choose(less(to_int(left), zero), I8::load(degrees), zero);
    for (std::size_t i = 0; i < U8::kBlocks; ++i) left.block[i] = hn::Add(left.block[i], left.block[i]);
  }
  return sum_of(sum);
}

/// `kPartition`: every pixel is wanted or to be left free. Four registers at a time.
template <bool kPartition>
HWY_INLINE void sweep_uniform(PixelCanvas& canvas, const WeightTiles& weights, SilhouetteCounts& counts) {
  BitSum covered, wanted, free;
  const std::uint32_t* all_wanted = weights.wanted.words.data();
  const std::uint32_t* all_free = weights.free.words.data();
  std::uint32_t* words = canvas.words.data();
  const std::size_t size = canvas.words.size();  // whole fours: see PixelCanvas
  for (std::size_t at = 0; at < size; at += 4 * kStep) {
    Words bits[4], want[4], leave[4];
    for (std::size_t i = 0; i < 4; ++i) {
      bits[i] = hn::Load(WordTag(), words + at + i * kStep);
      hn::Store(hn::Zero(WordTag()), WordTag(), words + at + i * kStep);
      want[i] = hn::And(bits[i], hn::Load(WordTag(), all_wanted + at + i * kStep));
      leave[i] = hn::And(bits[i], hn::Load(WordTag(), all_free + at + i * kStep));
    }
    if (!kPartition) covered.add(bits[0], bits[1], bits[2], bits[3]);
    wanted.add(want[0], want[1], want[2], want[3]);
    free.add(leave[0], leave[1], leave[2], leave[3]);
  }
  counts.wanted = wanted.total(), counts.free = free.total();
  counts.covered = kPartition ? counts.wanted + counts.free : covered.total();
  counts.wanted_sum = counts.wanted * static_cast<std::uint64_t>(weights.wanted_degree);
  counts.free_sum = counts.free * static_cast<std::uint64_t>(weights.free_degree);
}

HWY_INLINE void sweep_graded(PixelCanvas& canvas, const WeightTiles& weights, SilhouetteCounts& counts) {
  U8 covered = U8::all(0), wanted = U8::all(0), free = U8::all(0);
  const U8 zero = U8::all(0);
  for (std::size_t at = 0; at < canvas.words.size(); at += 8) {
    const U8 bits = U8::load(canvas.words.data() + at);
    if (!any(bits)) continue;
    zero.store(canvas.words.data() + at);
    const U8 all_wanted = U8::load(weights.wanted.words.data() + at),
             all_free = U8::load(weights.free.words.data() + at);
    const U8 want = bits & all_wanted, leave = bits & all_free;
    covered = covered + population(bits);
    wanted = wanted + population(want);
    free = free + population(leave);
    const std::int32_t* degrees = weights.degrees.data() + at * 32;
    if (any(want)) {
      counts.wanted_sum += any(want ^ all_wanted) ? weigh(want, degrees)
                                                  : static_cast<std::uint64_t>(weights.wanted_of_tile[at / 8]);
    }
    if (any(leave)) {
      counts.free_sum += any(leave ^ all_free) ? weigh(leave, degrees)
                                               : static_cast<std::uint64_t>(weights.free_of_tile[at / 8]);
    }
  }
  counts.covered = total(covered), counts.wanted = total(wanted), counts.free = total(free);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
