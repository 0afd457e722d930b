#pragma once
// Counter-based random streams (Philox4x32-10, Salmon et al. 2011). A stream is a function of its key and nothing else,
// so whoever holds the key draws the same numbers on any machine, in any order, with any number of threads.

#include <array>
#include <cstdint>

namespace espalier {

/// What a stream is for; streams of different purposes never meet.
enum class Purpose : std::uint8_t {
  sample = 1, initial, select, vary, resample, propose, swap, probe, test, close, points
};

/// Names one stream: 64-bit seed, purpose, and up to three coordinates. `lane` (24 bits) is the engine or island,
/// `individual` and `generation` are 32 bits each.
struct StreamKey {
  std::uint64_t seed = 0;
  Purpose purpose = Purpose::sample;
  std::uint32_t lane = 0;
  std::uint32_t individual = 0;
  std::uint32_t generation = 0;
};

/// A stream of random numbers; at most 2^34 words. A value: a copy continues from the same place.
class RandomStream {
 public:
  explicit RandomStream(const StreamKey& key);

  std::uint32_t next_u32() {
    if (used_ == 4) refill();
    return block_[used_++];
  }
  std::uint64_t next_u64() {
    const std::uint64_t high = next_u32();
    return high << 32 | next_u32();
  }
  /// Uniform in [0, 1), a multiple of 2^-53.
  double next_unit() { return static_cast<double>(next_u64() >> 11) * 0x1.0p-53; }
  /// Uniform in 0..n-1, exactly (Lemire's multiplication with rejection). n >= 1.
  std::uint32_t below(std::uint32_t n);
  /// True with probability p.
  bool chance(double p) { return next_unit() < p; }

 private:
  void refill();

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  std::uint32_t used_ = 4;
};

}  // namespace espalier
