// Drawing FoldMeshes: four corners and eight faces at a time to the edges that matter; where those cross rows of the
// image the number of faces over it changes, and running sums of eight rows at a time tell what is covered. Every edge
// is worked out once, for both of its faces, so no pixel slips between them. Included once per target.

#if defined(ESPALIER_SCORE_FOLD_DRAW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_FOLD_DRAW_INL_H
#undef ESPALIER_SCORE_FOLD_DRAW_INL_H
#else
#define ESPALIER_SCORE_FOLD_DRAW_INL_H
#endif

#include <algorithm>

#include "model/model.h"
#include "score/eight-inl.h"
#include "score/fold_scratch.h"
#include "score/pixel_canvas.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

/// Pixels [low, high) of the image by axis, relative to the view's origin; what the mesh's corners enclose.
struct FoldReach {
  std::int32_t low[2], high[2];
  bool empty() const { return low[0] >= high[0] || low[1] >= high[1]; }
};

/// Corners further than this from the origin are left to OutlineMaker: floats would lose a thousandth of a pixel.
inline constexpr float kFarthestCorner = 4096;
inline constexpr std::size_t kBandWords = 1 << 15;  // of FoldScratch::begins: what stays in the second cache

HWY_INLINE void place_corners(const FoldMesh& mesh, FoldScratch& s) {
  const double(&m)[3][4] = s.view.matrix;
  D4 row[3][4];
  for (int r = 0; r < 3; ++r)
    for (int j = 0; j < 4; ++j) row[r][j] = D4::all(m[r][j]);
  const D4 one = D4::all(1);
  for (std::size_t i = 0; i < mesh.corners; i += 4) {
    const D4 x = load_doubles(mesh.place[0].data() + i), y = load_doubles(mesh.place[1].data() + i),
             z = load_doubles(mesh.place[2].data() + i);
    const D4 per_w = one / (row[2][0] * x + row[2][1] * y + (row[2][2] * z + row[2][3]));
    store_floats((row[0][0] * x + row[0][1] * y + (row[0][2] * z + row[0][3])) * per_w, s.x.data() + i);
    store_floats((row[1][0] * x + row[1][1] * y + (row[1][2] * z + row[1][3])) * per_w, s.y.data() + i);
  }
}

HWY_INLINE float least_of(const F8& a) {
  alignas(32) float lane[8];
  a.store(lane);
  return *std::min_element(lane, lane + 8);
}

/// Sets the corners' rows; false if some corner lies too far off.
HWY_INLINE bool set_rows(const FoldMesh& mesh, const Projection& projection, FoldScratch& s, FoldReach& reach) {
  const F8 half = F8::all(0.5f);
  F8 low[2] = {F8::all(1e9f), F8::all(1e9f)}, high[2] = {F8::all(1e9f), F8::all(1e9f)};  // high: negated
  const std::size_t padded = mesh.place[0].size();
  for (std::size_t i = (mesh.corners + 3) / 4 * 4; i < padded; i += 4)  // the second half of the last eight
    for (std::size_t k = i; k < i + 4; ++k) s.x[k] = s.x[mesh.corners - 1], s.y[k] = s.y[mesh.corners - 1];
  for (std::size_t i = 0; i < padded; i += 8) {
    const F8 x = F8::load(s.x.data() + i), y = F8::load(s.y.data() + i);
    truncate(rounded_up(y - half)).store(s.row.data() + i);
    low[0] = smaller(low[0], x), high[0] = smaller(high[0], -x);
    low[1] = smaller(low[1], y), high[1] = smaller(high[1], -y);
  }
  for (int i = 0; i < 2; ++i) {
    const float least = least_of(low[i]), most = -least_of(high[i]);
    if (!(least > -kFarthestCorner && most < kFarthestCorner)) return false;
    const auto size = static_cast<std::int32_t>(i == 0 ? projection.width : projection.height);
    reach.low[i] = std::max(static_cast<std::int32_t>(std::ceil(least - 0.5f)), -s.view.origin[i]);
    reach.high[i] = std::min(static_cast<std::int32_t>(std::ceil(most - 0.5f)), size - s.view.origin[i]);
  }
  return true;
}

HWY_INLINE void set_turns(const FoldMesh& mesh, FoldScratch& s) {
  const F8 e0 = F8::all(s.view.eye[0]), e1 = F8::all(s.view.eye[1]), e2 = F8::all(s.view.eye[2]),
           e3 = F8::all(s.view.eye[3]), zero = F8::all(0);
  for (std::size_t i = 0; i < mesh.faces; i += 8) {
    const F8 at = F8::load(mesh.plane[0].data() + i) * e0 + F8::load(mesh.plane[1].data() + i) * e1 +
                  F8::load(mesh.plane[2].data() + i) * e2 + F8::load(mesh.plane[3].data() + i) * e3;
    to_int(less(zero, at)).store(s.turn.data() + i);
  }
}

/// Collects the edges that matter and cross a row. No jumps: there would be no telling where they go.
HWY_INLINE void keep_steps(const FoldMesh& mesh, FoldScratch& s) {
  const std::int32_t* const turn = s.turn.data();
  const std::int32_t* const row = s.row.data();
  const FoldMesh::Fold* const folds = mesh.folds.data();
  std::uint32_t* const folded = s.folded.data();
  std::size_t count = 0;
  for (std::size_t i = 0, n = mesh.folds.size(); i < n; ++i) {
    folded[count] = static_cast<std::uint32_t>(i);
    count += turn[folds[i].left] != turn[folds[i].right] ? 1 : 0;
  }
  FoldScratch::Step* to = s.steps.data();
  // Downwards along an edge a face that looks at the viewer (turn -1) lies to the left: one face less beyond it.
  const auto keep = [&](std::uint32_t from, std::uint32_t end, std::int32_t step) {
    const bool down = row[from] < row[end];
    *to = {down ? from : end, down ? end : from, down ? step : -step};
    to += row[from] != row[end] ? 1 : 0;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const FoldMesh::Fold& fold = folds[folded[i]];
    keep(fold.from, fold.to, 2 * (turn[fold.left] - turn[fold.right]));
  }
  for (const FoldMesh::Border& border : mesh.borders) keep(border.from, border.to, 2 * turn[border.face] + 1);
  s.kept = static_cast<std::size_t>(to - s.steps.data());
}

/// A band of strips: rows [first, end), relative to the view's origin; `columns` of them wide, and one for what begins
/// beyond. Absolute: `strip` and `word`, of the first row and column.
struct FoldBand {
  std::int32_t first, end, strip, word, columns, words;  // words: of FoldScratch::touched per strip
};

// In steps of 2^-32 pixels from row to row: whole numbers round up cheaply.
HWY_INLINE void mark_steps(const FoldBand& band, const FoldReach& reach, FoldScratch& s) {
  constexpr double kOne = 4294967296.0;
  const std::int32_t origin_row = s.view.origin[1], indent = ((reach.low[0] + s.view.origin[0]) & 31);
  const float left = static_cast<float>(reach.low[0]) + 0.5f;
  const std::int64_t columns = band.columns, stride = (columns + 1) * 8;
  const float* const x = s.x.data();
  const float* const y = s.y.data();
  const std::int32_t* const rows = s.row.data();
  std::int32_t* const begins = s.begins.data();
  std::uint8_t* const touched = s.touched.data();
  for (const FoldScratch::Step *edge = s.steps.data(), *last = edge + s.kept; edge != last; ++edge) {
    const std::int32_t first = std::max(rows[edge->upper], band.first), end = std::min(rows[edge->lower], band.end);
    if (first >= end) continue;
    const float ax = x[edge->upper], ay = y[edge->upper];
    const float slope = (x[edge->lower] - ax) / (y[edge->lower] - ay);
    const float from = ax - left + slope * (static_cast<float>(first) + 0.5f - ay);
    std::int64_t at = static_cast<std::int64_t>(double{from} * kOne) + 0xffffffff;
    // An edge in one row may be all but level; one in two rows is no wider than it may be long.
    const std::int64_t step = end - first > 1 ? static_cast<std::int64_t>(double{slope} * kOne) : 0;
    for (std::int32_t row = first + origin_row; row < end + origin_row; ++row, at += step) {
      const std::int64_t column = std::min(std::max(at >> 32, std::int64_t{0}), columns);
      const std::int32_t strip = (row >> 3) - band.strip;
      begins[strip * stride + column * 8 + (row & 7)] += edge->step;
      touched[strip * band.words + ((static_cast<std::int32_t>(column) + indent) >> 5)] = 1;
    }
  }
}

HWY_INLINE U8 not_zero(const I8& a) {
  U8 r;
  for (std::size_t i = 0; i < U8::kBlocks; ++i) {
    const auto set = hn::Ne(a.block[i], hn::Zero(IntTag()));
    r.block[i] = hn::BitCast(WordTag(), hn::VecFromMask(IntTag(), set));
  }
  return r;
}

HWY_INLINE U8 shifted_up(const U8& a, int count) {
  U8 r;
  for (std::size_t i = 0; i < U8::kBlocks; ++i) r.block[i] = hn::ShiftLeftSame(a.block[i], count);
  return r;
}

/// Sums up one strip into a row of tiles, and clears it.
HWY_INLINE void fill_strip(std::int32_t* begins, std::uint8_t* touched, std::int32_t first, std::int32_t end,
                           std::uint32_t* words) {
  I8 over = I8::all(0);
  const I8 zero = I8::all(0);
  for (std::int32_t column = first; column < end; words += 8, ++touched) {
    const std::int32_t stop = std::min((column | 31) + 1, end);
    U8 bits = not_zero(over);
    if (*touched == 0) {
      const std::int32_t wide = stop - column;
      if (wide < 32) bits = bits & U8::all((1u << wide) - 1);
      column = stop, begins += 8 * wide;
    } else {
      *touched = 0;
      bits = U8::all(0);
      for (; column < stop; ++column, begins += 8) {
        over = over + I8::load(begins);
        zero.store(begins);
        const U8 covered = not_zero(over);  // all ones: minus one
        for (std::size_t i = 0; i < U8::kBlocks; ++i)
          bits.block[i] = hn::Sub(hn::Add(bits.block[i], bits.block[i]), covered.block[i]);
      }
    }
    bits = shifted_up(bits, (32 - stop) & 31);
    (U8::load(words) | bits).store(words);
  }
  zero.store(begins);
  *touched = 0;  // where the image ends with a word, that of the extra column
}

HWY_INLINE void fill_folds(const FoldReach& reach, FoldScratch& s, PixelCanvas& canvas) {
  const std::int32_t first_column = reach.low[0] + s.view.origin[0], end_column = reach.high[0] + s.view.origin[0];
  FoldBand band;
  band.word = first_column >> 5;
  band.columns = end_column - first_column;
  band.words = (end_column >> 5) - band.word + 2;
  const std::size_t per_strip = static_cast<std::size_t>(band.columns + 1) * 8;
  const std::int32_t strips = static_cast<std::int32_t>(std::max<std::size_t>(1, kBandWords / per_strip));
  if (s.begins.size() < per_strip * static_cast<std::size_t>(strips)) {
    s.begins.resize(per_strip * static_cast<std::size_t>(strips));
  }
  const auto touches = static_cast<std::size_t>(strips * band.words);
  if (s.touched.size() < touches) s.touched.resize(touches);
  for (band.first = reach.low[1]; band.first < reach.high[1]; band.first = band.end) {
    band.strip = (band.first + s.view.origin[1]) >> 3;
    band.end = std::min((band.strip + strips) * 8 - s.view.origin[1], reach.high[1]);
    mark_steps(band, reach, s);
    const std::int32_t last = (band.end - 1 + s.view.origin[1]) >> 3;
    for (std::int32_t strip = band.strip; strip <= last; ++strip) {
      const auto at = static_cast<std::size_t>(strip - band.strip);
      fill_strip(s.begins.data() + at * per_strip, s.touched.data() + at * static_cast<std::size_t>(band.words),
                 first_column, end_column,
                 canvas.words.data() +
                     (static_cast<std::size_t>(strip) * canvas.across + static_cast<std::size_t>(band.word)) * 8);
    }
  }
}

/// Draws a placed mesh, convex or not; false where OutlineMaker must.
HWY_INLINE bool draw_folds(const FoldMesh& mesh, const Instance& instance, const Projection& projection,
                           FoldScratch& s, PixelCanvas& canvas) {
  const FoldView::Result result = s.view.set(mesh, projection, instance.model_from_mesh);
  if (result != FoldView::Result::ready) return result == FoldView::Result::nothing;
  s.reserve(mesh);
  place_corners(mesh, s);
  FoldReach reach;
  if (!set_rows(mesh, projection, s, reach)) return false;
  if (reach.empty()) return true;
  set_turns(mesh, s);
  keep_steps(mesh, s);
  fill_folds(reach, s, canvas);
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
