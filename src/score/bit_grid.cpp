#include "score/bit_grid.h"

#include <bit>

#include "base/check.h"

namespace espalier {

std::uint64_t BitGrid::count() const {
  std::uint64_t n = 0;
  for (const std::uint32_t word : words_) n += static_cast<std::uint64_t>(std::popcount(word));
  return n;
}

void unite(BitGrid& a, const BitGrid& b) {
  CHECK(a.nx() == b.nx() && a.ny() == b.ny() && a.nz() == b.nz());
  for (std::size_t i = 0; i < a.size(); ++i) a.data()[i] |= b.data()[i];
}

}  // namespace espalier
