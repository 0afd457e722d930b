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

/// Set bits of up to 31 registers, and a running sum of such.
class BitSum {
 public:
  HWY_INLINE BitSum() {  // written out: implicit constructors are not compiled for the target
    bytes_ = hn::Zero(ByteTag());
    sums_ = hn::Zero(SumTag());
  }
  HWY_INLINE void add(const Words& words) {
    bytes_ = hn::Add(bytes_, hn::PopulationCount(hn::BitCast(ByteTag(), words)));
  }
  /// At least after every 31 additions.
  HWY_INLINE void flush() {
    sums_ = hn::Add(sums_, hn::SumsOf8(bytes_));
    bytes_ = hn::Zero(ByteTag());
  }
  HWY_INLINE std::uint64_t total() const { return hn::GetLane(hn::SumOfLanes(SumTag(), sums_)); }

 private:
  hn::Vec<ByteTag> bytes_;
  hn::Vec<SumTag> sums_;
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
  HWY_INLINE void flush() {}
  HWY_INLINE std::uint64_t total() const { return sum_; }

 private:
  std::uint64_t sum_;
};
#endif

/// Bits of a & b over the tiles of one block.
HWY_INLINE void add_common(const std::uint32_t* a, const std::uint32_t* b, std::size_t words, BitSum& sum) {
  for (std::size_t i = 0; i < words; i += kStep) {
    sum.add(hn::And(hn::Load(WordTag(), a + i), hn::Load(WordTag(), b + i)));
  }
  sum.flush();
}

/// Bits over the tiles of one block, which are cleared.
HWY_INLINE void add_and_clear(std::uint32_t* a, std::size_t words, BitSum& sum) {
  for (std::size_t i = 0; i < words; i += kStep) {
    sum.add(hn::Load(WordTag(), a + i));
    hn::Store(hn::Zero(WordTag()), WordTag(), a + i);
  }
  sum.flush();
}

HWY_INLINE bool any_set(const std::uint32_t* a, std::size_t words) {
  Words all = hn::Zero(WordTag());
  for (std::size_t i = 0; i < words; i += kStep) all = hn::Or(all, hn::Load(WordTag(), a + i));
  return !hn::AllTrue(WordTag(), hn::Eq(all, hn::Zero(WordTag())));
}

struct SweepSums {
  BitSum covered, wanted, overlap;
  HWY_INLINE SweepSums() {}
};

/// One block of kBlockTiles tiles (fewer at the end of a row): counts and clears it.
template <class Count>
HWY_INLINE void sweep_block(std::uint32_t* once, std::uint32_t* twice, const std::uint32_t* target, bool in_target,
                            Count words, SweepSums& sums) {
  if (in_target) add_common(once, target, words, sums.wanted);
  add_and_clear(once, words, sums.covered);
  if (any_set(twice, words)) add_and_clear(twice, words, sums.overlap);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
