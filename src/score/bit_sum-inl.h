// BitSum: counts the bits that are set in many registers. Included once per target.

#if defined(ESPALIER_SCORE_BIT_SUM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_BIT_SUM_INL_H
#undef ESPALIER_SCORE_BIT_SUM_INL_H
#else
#define ESPALIER_SCORE_BIT_SUM_INL_H
#endif

#include <bit>

#include "score/eight-inl.h"

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

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
