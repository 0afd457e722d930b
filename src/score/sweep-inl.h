// The sweep: counts the bits of what was drawn against the targets and clears it, tile row by tile row. Included once
// per target.

#if defined(ESPALIER_SCORE_SWEEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_SWEEP_INL_H
#undef ESPALIER_SCORE_SWEEP_INL_H
#else
#define ESPALIER_SCORE_SWEEP_INL_H
#endif

#include <bit>
#include <cstring>

#include "score/eight-inl.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
using ByteTag = hn::Repartition<std::uint8_t, WordTag>;
using SumTag = hn::Repartition<std::uint64_t, WordTag>;

/// Running count of set bits: per byte for up to 31 additions, then in 64 bits.
class BitSum {
 public:
  HWY_INLINE BitSum() {  // written out: the implicit one would not be compiled for the target
    bytes_ = hn::Zero(ByteTag());
    sums_ = hn::Zero(SumTag());
  }
  HWY_INLINE void add(const hn::Vec<WordTag>& words) {
    bytes_ = hn::Add(bytes_, hn::PopulationCount(hn::BitCast(ByteTag(), words)));
  }
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
  HWY_INLINE void add(const hn::Vec<WordTag>& words) {
    alignas(32) std::uint32_t lane[8];
    hn::Store(words, WordTag(), lane);
    for (std::size_t i = 0; i < kStep; ++i) sum_ += static_cast<std::uint64_t>(std::popcount(lane[i]));
  }
  HWY_INLINE void flush() {}
  HWY_INLINE std::uint64_t total() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};
#endif

/// Bits of a & b over n words; n is a multiple of 8.
HWY_INLINE std::uint64_t count_common(const std::uint32_t* a, const std::uint32_t* b, std::size_t n) {
  BitSum sum;
  for (std::size_t i = 0; i < n;) {
    const std::size_t end = i + 30 * kStep < n ? i + 30 * kStep : n;
    for (; i < end; i += kStep) sum.add(hn::And(hn::Load(WordTag(), a + i), hn::Load(WordTag(), b + i)));
    sum.flush();
  }
  return sum.total();
}

struct SweepSums {
  BitSum covered, wanted, overlap;
  HWY_INLINE SweepSums() {}
};

/// Adds up one stretch of a tile row and clears it.
HWY_INLINE void sweep_row(std::uint32_t* once, std::uint32_t* twice, const std::uint32_t* target, std::size_t n,
                          SweepSums& sums) {
  const auto zero = hn::Zero(WordTag());
  for (std::size_t i = 0; i < n;) {
    const std::size_t end = i + 30 * kStep < n ? i + 30 * kStep : n;
    for (; i < end; i += kStep) {
      const auto one = hn::Load(WordTag(), once + i);
      sums.covered.add(one);
      sums.wanted.add(hn::And(one, hn::Load(WordTag(), target + i)));
      sums.overlap.add(hn::Load(WordTag(), twice + i));
      hn::Store(zero, WordTag(), once + i);
      hn::Store(zero, WordTag(), twice + i);
    }
    sums.covered.flush();
    sums.wanted.flush();
    sums.overlap.flush();
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
