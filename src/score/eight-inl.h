// Eight lanes of 32 bits, or four of 64, on every machine: one AVX2 register, two of 128 bits, or plain numbers. All
// paths give the same bytes: no fused multiply-add, no approximations, shifts by 32 and more give 0. Included once per
// target.

#if defined(ESPALIER_SCORE_EIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_SCORE_EIGHT_INL_H
#undef ESPALIER_SCORE_EIGHT_INL_H
#else
#define ESPALIER_SCORE_EIGHT_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 8>;
using IntTag = hn::RebindToSigned<FloatTag>;
using WordTag = hn::RebindToUnsigned<FloatTag>;
using DoubleTag = hn::CappedTag<double, 4>;
inline constexpr std::size_t kStep = hn::MaxLanes(FloatTag());

template <class Tag>
struct Eight {
  using Lane = hn::TFromD<Tag>;
  static constexpr std::size_t kStep = hn::MaxLanes(Tag());
  static constexpr std::size_t kBlocks = 32 / sizeof(Lane) / kStep;
  hn::Vec<Tag> block[kBlocks];

  static HWY_INLINE Eight all(Lane value) {
    Eight r;
    for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::Set(Tag(), value);
    return r;
  }
  static HWY_INLINE Eight load_anywhere(const Lane* from) {
    Eight r;
    for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::LoadU(Tag(), from + i * kStep);
    return r;
  }
  /// Aligned to 32 bytes.
  static HWY_INLINE Eight load(const Lane* from) {
    Eight r;
    for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::Load(Tag(), from + i * kStep);
    return r;
  }
  HWY_INLINE void store(Lane* to) const {
    for (std::size_t i = 0; i < kBlocks; ++i) hn::Store(block[i], Tag(), to + i * kStep);
  }
};
using F8 = Eight<FloatTag>;
using I8 = Eight<IntTag>;
using U8 = Eight<WordTag>;
using D4 = Eight<DoubleTag>;

#define ESPALIER_EIGHT_BINARY(name, call)                                                        \
  template <class Tag>                                                                           \
  HWY_INLINE Eight<Tag> name(const Eight<Tag>& a, const Eight<Tag>& b) {                         \
    Eight<Tag> r;                                                                                \
    for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::call(a.block[i], b.block[i]);     \
    return r;                                                                                    \
  }
ESPALIER_EIGHT_BINARY(operator+, Add)
ESPALIER_EIGHT_BINARY(operator-, Sub)
ESPALIER_EIGHT_BINARY(operator*, Mul)
ESPALIER_EIGHT_BINARY(operator/, Div)
ESPALIER_EIGHT_BINARY(operator|, Or)
ESPALIER_EIGHT_BINARY(operator&, And)
ESPALIER_EIGHT_BINARY(operator^, Xor)
ESPALIER_EIGHT_BINARY(smaller, Min)
ESPALIER_EIGHT_BINARY(larger, Max)
#undef ESPALIER_EIGHT_BINARY

#define ESPALIER_EIGHT_UNARY(name, call)                                              \
  template <class Tag>                                                                \
  HWY_INLINE Eight<Tag> name(const Eight<Tag>& a) {                                   \
    Eight<Tag> r;                                                                     \
    for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::call(a.block[i]);      \
    return r;                                                                         \
  }
ESPALIER_EIGHT_UNARY(square_root, Sqrt)
ESPALIER_EIGHT_UNARY(magnitude, Abs)
ESPALIER_EIGHT_UNARY(rounded_up, Ceil)
ESPALIER_EIGHT_UNARY(operator-, Neg)
#undef ESPALIER_EIGHT_UNARY

/// All bits set where a < b (never for NaN).
template <class Tag>
HWY_INLINE Eight<Tag> less(const Eight<Tag>& a, const Eight<Tag>& b) {
  Eight<Tag> r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::VecFromMask(Tag(), hn::Lt(a.block[i], b.block[i]));
  return r;
}

/// All bits set where a and b differ.
template <class Tag>
HWY_INLINE Eight<Tag> different(const Eight<Tag>& a, const Eight<Tag>& b) {
  Eight<Tag> r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::VecFromMask(Tag(), hn::Ne(a.block[i], b.block[i]));
  return r;
}

/// a where the lane of `test`, made by one of these, is set, else b.
template <class Tag>
HWY_INLINE Eight<Tag> choose(const Eight<Tag>& test, const Eight<Tag>& a, const Eight<Tag>& b) {
  Eight<Tag> r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) {
    r.block[i] = hn::IfThenElse(hn::MaskFromVec(test.block[i]), a.block[i], b.block[i]);
  }
  return r;
}

/// Towards zero. Beyond the range of int the result is one fixed value per target, the same for equal inputs.
HWY_INLINE I8 truncate(const F8& a) {
  I8 r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) {
#if HWY_TARGET == HWY_AVX2
    r.block[i] = hn::Vec<IntTag>{_mm256_cvttps_epi32(a.block[i].raw)};
#elif HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
    r.block[i] = hn::Vec<IntTag>{_mm_cvttps_epi32(a.block[i].raw)};
#else
    r.block[i] = hn::ConvertTo(IntTag(), a.block[i]);
#endif
  }
  return r;
}

/// The lowest 32 - n bits of each lane, for n >= 0; none from 32 on.
HWY_INLINE U8 low_bits_but(const I8& n) {
  U8 r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) {
    const auto count = hn::BitCast(WordTag(), n.block[i]);
    const auto ones = hn::Set(WordTag(), ~0u);
#if HWY_TARGET == HWY_AVX2
    r.block[i] = hn::Shr(ones, count);
#else
    const auto most = hn::BitCast(WordTag(), hn::Min(n.block[i], hn::Set(IntTag(), 31)));
    const auto fits = hn::MaskFromVec(hn::BitCast(WordTag(), hn::VecFromMask(
        IntTag(), hn::Lt(n.block[i], hn::Set(IntTag(), 32)))));
    static_cast<void>(count);
    r.block[i] = hn::IfThenElseZero(fits, hn::Shr(ones, most));
#endif
  }
  return r;
}

using HalfTag = hn::Rebind<float, DoubleTag>;

/// Four doubles as floats, and back.
HWY_INLINE void store_floats(const D4& v, float to[4]) {
  for (std::size_t i = 0; i < D4::kBlocks; ++i) {
    hn::Store(hn::DemoteTo(HalfTag(), v.block[i]), HalfTag(), to + i * D4::kStep);
  }
}
HWY_INLINE D4 load_doubles(const float from[4]) {
  D4 r;
  for (std::size_t i = 0; i < D4::kBlocks; ++i) {
    r.block[i] = hn::PromoteTo(DoubleTag(), hn::Load(HalfTag(), from + i * D4::kStep));
  }
  return r;
}

HWY_INLINE F8 to_float(const U8& bits) {
  F8 r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::BitCast(FloatTag(), bits.block[i]);
  return r;
}
HWY_INLINE I8 to_int(const U8& bits) {
  I8 r;
  for (std::size_t i = 0; i < r.kBlocks; ++i) r.block[i] = hn::BitCast(IntTag(), bits.block[i]);
  return r;
}

HWY_INLINE I8 to_int(const F8& bits) {
  I8 r;
  for (std::size_t i = 0; i < F8::kBlocks; ++i) r.block[i] = hn::BitCast(IntTag(), bits.block[i]);
  return r;
}

HWY_INLINE U8 bits_of(const F8& a) {
  U8 r;
  for (std::size_t i = 0; i < U8::kBlocks; ++i) r.block[i] = hn::BitCast(WordTag(), a.block[i]);
  return r;
}

/// Some lane is not all ones.
HWY_INLINE bool any_but(const U8& a) {
  alignas(32) std::uint32_t lane[8];
  a.store(lane);
  std::uint32_t all = ~0u;
  for (const std::uint32_t v : lane) all &= v;
  return all != ~0u;
}

/// 0, 1, .. 7 plus `first`.
HWY_INLINE F8 lanes_from(float first) {
  alignas(32) static constexpr float kLane[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  return F8::load(kLane) + F8::all(first);
}

HWY_INLINE std::uint64_t sum_of(const I8& a) {
  alignas(32) std::int32_t lane[8];
  a.store(lane);
  std::uint64_t sum = 0;
  for (const std::int32_t v : lane) sum += static_cast<std::uint64_t>(std::int64_t{v});
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif  // per target
