// The sweep: counts the bits of what was drawn against the targets and clears it, tile row by tile row. Included once
// per target.

#if defined(ESPALIER_SCORE_SWEEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_SWEEP_INL_H
#undef ESPALIER_SCORE_SWEEP_INL_H
#else
#define ESPALIER_SCORE_SWEEP_INL_H
#endif

#include "score/bit_sum-inl.h"
#include "score/counting_canvas.h"
#include "score/voxel_canvas.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

HWY_INLINE Words words_at(const std::uint32_t* a) { return hn::Load(WordTag(), a); }
HWY_INLINE Words common_at(const std::uint32_t* a, const std::uint32_t* b) { return hn::And(words_at(a), words_at(b)); }
HWY_INLINE Words beyond_at(const std::uint32_t* a, const std::uint32_t* b) {
  return hn::AndNot(words_at(b), words_at(a));
}

/// Bits of a & b over the tiles of one block.
HWY_INLINE void add_common(const std::uint32_t* a, const std::uint32_t* b, std::size_t words, BitSum& sum) {
  std::size_t i = 0;
  for (; i + 4 * kStep <= words; i += 4 * kStep) {
    sum.add(common_at(a + i, b + i), common_at(a + i + kStep, b + i + kStep),
            common_at(a + i + 2 * kStep, b + i + 2 * kStep), common_at(a + i + 3 * kStep, b + i + 3 * kStep));
  }
  for (; i < words; i += kStep) sum.add(common_at(a + i, b + i));
}

/// Bits of a & ~b.
HWY_INLINE void add_beyond(const std::uint32_t* a, const std::uint32_t* b, std::size_t words, BitSum& sum) {
  std::size_t i = 0;
  for (; i + 4 * kStep <= words; i += 4 * kStep) {
    sum.add(beyond_at(a + i, b + i), beyond_at(a + i + kStep, b + i + kStep),
            beyond_at(a + i + 2 * kStep, b + i + 2 * kStep), beyond_at(a + i + 3 * kStep, b + i + 3 * kStep));
  }
  for (; i < words; i += kStep) sum.add(beyond_at(a + i, b + i));
}

HWY_INLINE void add_all(const std::uint32_t* a, std::size_t words, BitSum& sum) {
  std::size_t i = 0;
  for (; i + 4 * kStep <= words; i += 4 * kStep) {
    sum.add(words_at(a + i), words_at(a + i + kStep), words_at(a + i + 2 * kStep), words_at(a + i + 3 * kStep));
  }
  for (; i < words; i += kStep) sum.add(words_at(a + i));
}

HWY_INLINE void clear(std::uint32_t* a, std::size_t words) {
  for (std::size_t i = 0; i < words; i += kStep) hn::Store(hn::Zero(WordTag()), WordTag(), a + i);
}

HWY_INLINE bool any_set(const std::uint32_t* a, std::size_t words) {
  Words all = hn::Zero(WordTag());
  for (std::size_t i = 0; i < words; i += kStep) all = hn::Or(all, words_at(a + i));
  return !hn::AllTrue(WordTag(), hn::Eq(all, hn::Zero(WordTag())));
}

struct SweepSums {
  BitSum wanted, spilled, overlap;
  HWY_INLINE SweepSums() {}
};

/// How the union of the targets fills a block.
enum class BlockUse : std::uint8_t { none, some, all };

/// Counts one block of kBlockTiles tiles (fewer at the end of a row). True if some voxel is covered twice.
template <class Count>
HWY_INLINE bool count_block(const std::uint32_t* once, const std::uint32_t* twice, const std::uint32_t* target,
                            BlockUse use, Count words, SweepSums& sums) {
  if (use == BlockUse::some) {
    add_common(once, target, words, sums.wanted);
    add_beyond(once, target, words, sums.spilled);
  } else {
    add_all(once, words, use == BlockUse::all ? sums.wanted : sums.spilled);
  }
  if (!any_set(twice, words)) return false;
  add_all(twice, words, sums.overlap);
  return true;
}

/// The same, and clears it.
template <class Count>
HWY_INLINE void sweep_block(std::uint32_t* once, std::uint32_t* twice, const std::uint32_t* target, BlockUse use,
                            Count words, SweepSums& sums) {
  if (count_block(once, twice, target, use, words, sums)) clear(twice, words);
  clear(once, words);
}

/// A block of a counting canvas: what is covered at all, and twice or more.
HWY_INLINE void flatten_block(const std::uint32_t* planes, std::uint32_t* once, std::uint32_t* twice) {
  for (std::int32_t tile = 0; tile < kBlockTiles; ++tile, planes += 8 * kCountPlanes, once += 8, twice += 8) {
    U8 more = U8::load(planes + 8);
    for (std::size_t plane = 2; plane < kCountPlanes; ++plane) more = more | U8::load(planes + plane * 8);
    more.store(twice);
    (more | U8::load(planes)).store(once);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
