#include "base/random.h"

#include <Random123/philox.h>

#include "base/check.h"

namespace espalier {

RandomStream::RandomStream(const StreamKey& key)
    : key_{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)},
      counter_{0, static_cast<std::uint32_t>(key.purpose) << 24 | key.lane, key.individual, key.generation} {
  CHECK(key.lane < 1u << 24);
}

void RandomStream::refill() {
  const r123::Philox4x32 philox;
  const auto out = philox({{counter_[0], counter_[1], counter_[2], counter_[3]}}, {{key_[0], key_[1]}});
  for (int i = 0; i < 4; ++i) block_[i] = out[i];
  ++counter_[0];
  used_ = 0;
}

std::uint32_t RandomStream::below(std::uint32_t n) {
  DCHECK(n >= 1);
  std::uint64_t product = std::uint64_t{next_u32()} * n;
  if (static_cast<std::uint32_t>(product) < n) {
    const std::uint32_t threshold = -n % n;  // 2^32 mod n: the words that would favour some values
    while (static_cast<std::uint32_t>(product) < threshold) product = std::uint64_t{next_u32()} * n;
  }
  return static_cast<std::uint32_t>(product >> 32);
}

}  // namespace espalier
