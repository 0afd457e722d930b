// The sweep: counts the bits of what was drawn against the targets and clears it, tile row by tile row. Included once
// per target.

#if defined(ESPALIER_SCORE_SWEEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_SWEEP_INL_H
#undef ESPALIER_SCORE_SWEEP_INL_H
#else
#define ESPALIER_SCORE_SWEEP_INL_H
#endif

#include <bit>

#include "score/eight-inl.h"
#include "score/voxel_canvas.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

using Words = hn::Vec<WordTag>;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
using ByteTag = hn::Repartition<std::uint8_t, WordTag>;
using SumTag = hn::Repartition<std::uint64_t, WordTag>;

/// Counts set bits, four registers at a time by carry-save addition: ones_ and twos_ hold what has not made up a four
/// yet (Harley and Seal; Mula, Kurz and Lemire 2018).
class BitSum {
 public:
  HWY_INLINE BitSum() {  // written out: implicit constructors are not compiled for the target
    ones_ = twos_ = hn::Zero(WordTag());
    fours_ = singles_ = hn::Zero(SumTag());
  }
  HWY_INLINE void add(const Words& words) { singles_ = hn::Add(singles_, bits_in(words)); }
  HWY_INLINE void add(const Words& a, const Words& b, const Words& c, const Words& d) {
    const Words first = carry(ones_, a, b), second = carry(ones_, c, d);
    fours_ = hn::Add(fours_, bits_in(carry(twos_, first, second)));
  }
  HWY_INLINE std::uint64_t total() const {
    const auto sum = hn::Add(hn::ShiftLeft<2>(fours_), hn::Add(singles_, bits_in(ones_)));
    return hn::GetLane(hn::SumOfLanes(SumTag(), hn::Add(sum, hn::ShiftLeft<1>(bits_in(twos_)))));
  }

 private:
  static HWY_INLINE hn::Vec<SumTag> bits_in(const Words& words) {
    return hn::SumsOf8(hn::PopulationCount(hn::BitCast(ByteTag(), words)));
  }
  /// sum + a + b, bit by bit: the sum stays in `sum`, the carry is returned.
  static HWY_INLINE Words carry(Words& sum, const Words& a, const Words& b) {
    const Words half = hn::Xor(sum, a);
    const Words carried = hn::Or(hn::And(sum, a), hn::And(half, b));
    sum = hn::Xor(half, b);
    return carried;
  }

  Words ones_, twos_;
  hn::Vec<SumTag> fours_, singles_;
};
#else
class BitSum {
 public:
  HWY_INLINE BitSum() : sum_(0) {}
  HWY_INLINE void add(const Words& words) {
    alignas(32) std::uint32_t lane[8];
    hn::Store(words, WordTag(), lane);
    for (std::size_t i = 0; i < kStep; ++i) sum_ += static_cast<std::uint64_t>(std::popcount(lane[i]));
  }
  HWY_INLINE void add(const Words& a, const Words& b, const Words& c, const Words& d) {
    add(a), add(b), add(c), add(d);
  }
  HWY_INLINE std::uint64_t total() const { return sum_; }

 private:
  std::uint64_t sum_;
};
#endif

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

/// One block of kBlockTiles tiles (fewer at the end of a row): counts and clears it.
template <class Count>
HWY_INLINE void sweep_block(std::uint32_t* once, std::uint32_t* twice, const std::uint32_t* target, BlockUse use,
                            Count words, SweepSums& sums) {
  if (use == BlockUse::some) {
    add_common(once, target, words, sums.wanted);
    add_beyond(once, target, words, sums.spilled);
  } else {
    add_all(once, words, use == BlockUse::all ? sums.wanted : sums.spilled);
  }
  clear(once, words);
  if (any_set(twice, words)) {
    add_all(twice, words, sums.overlap);
    clear(twice, words);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
