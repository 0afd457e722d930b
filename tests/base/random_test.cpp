#include "base/random.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace espalier {
namespace {

TEST(RandomStream, IsAFunctionOfItsKey) {
  const StreamKey key{42, Purpose::test, 1, 2, 3};
  RandomStream a(key), b(key);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next_u32(), b.next_u32());
}

TEST(RandomStream, EveryCoordinateChangesIt) {
  const StreamKey base{42, Purpose::test, 1, 2, 3};
  const std::vector<StreamKey> others = {{43, Purpose::test, 1, 2, 3}, {42ull + (1ull << 32), Purpose::test, 1, 2, 3},
                                         {42, Purpose::vary, 1, 2, 3}, {42, Purpose::test, 2, 2, 3},
                                         {42, Purpose::test, 1, 3, 3}, {42, Purpose::test, 1, 2, 4}};
  for (const StreamKey& other : others) EXPECT_NE(RandomStream(base).next_u64(), RandomStream(other).next_u64());
}

// Known answer of Philox4x32-10 for counter 0 and key 0 (Random123's kat_vectors), seen through a zero key: purpose 0.
TEST(RandomStream, MatchesThePublishedVectors) {
  RandomStream stream({0, static_cast<Purpose>(0), 0, 0, 0});
  EXPECT_EQ(stream.next_u32(), 0x6627e8d5u);
  EXPECT_EQ(stream.next_u32(), 0xe169c58du);
  EXPECT_EQ(stream.next_u32(), 0xbc57ac4cu);
  EXPECT_EQ(stream.next_u32(), 0x9b00dbd8u);
}

TEST(RandomStream, BelowIsUniform) {
  RandomStream stream({7, Purpose::test});
  constexpr int kBins = 7, kDraws = 70000;
  std::vector<int> counts(kBins);
  for (int i = 0; i < kDraws; ++i) ++counts[stream.below(kBins)];
  double chi2 = 0;
  for (int c : counts) chi2 += (c - kDraws / kBins) * (c - kDraws / kBins) / double(kDraws / kBins);
  EXPECT_LT(chi2, 22.5);  // 6 degrees of freedom, p = 0.001
}

}  // namespace
}  // namespace espalier
