#include "search/genesis_encoding.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"
#include "derivation/encode.h"
#include "search/start_draws.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;

int differences(const BitString& a, const BitString& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

TEST(GenesisEncoding, GrayNeighboursDifferInOneBit) {
  const auto graph = testing::start_draws_graph();
  const GenesisEncoding gray(*graph, {3, 8, 8, 10, 6}, true), plain(*graph, {3, 8, 8, 10, 6}, false);
  int worst_plain = 0;
  for (std::size_t gene = 0; gene < gray.genes(); ++gene) {
    const std::uint64_t count = std::uint64_t{1} << gray.bits_of(gene);
    std::set<std::uint32_t> quantiles;
    BitString before;
    for (std::uint64_t k = 0; k < count; ++k) {
      const bool continuous = graph->rules[0].draws[gene].shape == DrawShape::continuous;
      const double u = continuous ? double(k) / double(count - 1) : (double(k) + 0.5) / double(count);
      const bool circular = graph->rules[0].draws[gene].shape == DrawShape::circular;
      const auto quantile = static_cast<std::uint32_t>(u * 4294967295.0 - (circular ? 2147483648.0 / double(count) : 0));
      BitString string(gray.length()), other(gray.length());
      gray.put(quantile, gene, string);
      plain.put(quantile, gene, other);
      EXPECT_EQ(gray.quantile(string, gene), plain.quantile(other, gene));
      quantiles.insert(gray.quantile(string, gene));
      if (k > 0) {
        EXPECT_EQ(differences(string, before), 1) << gene << " " << k;
      }
      BitString plain_before(gray.length());
      if (k > 0) {
        plain.put(gray.quantile(before, gene), gene, plain_before);
        worst_plain = std::max(worst_plain, differences(other, plain_before));
      }
      before = string;
    }
    EXPECT_EQ(quantiles.size(), count) << "every number is another quantile";
  }
  EXPECT_EQ(worst_plain, 10) << "without Gray code a step may turn every bit";
}

TEST(GenesisEncoding, EveryStringDecodesAndEncodesToItself) {
  const auto graph = testing::start_draws_graph();
  for (const bool gray : {false, true}) {
    const GenesisEncoding encoding(*graph, {}, gray);
    EXPECT_EQ(encoding.length(), 3u + 8 + 8 + 8 + 8);
    for (std::uint32_t i = 0; i < 300; ++i) {
      RandomStream random({1, Purpose::test, 0, i, 0});
      BitString string(encoding.length());
      for (std::uint8_t& bit : string) bit = random.next_u32() & 1;
      const Derivation derivation = encoding.decode(string, 9);
      EXPECT_EQ(find_fault(*graph, derivation), "");
      EXPECT_EQ(derivation.detail_seed, 9u);
      EXPECT_EQ(encoding.encode(derivation), string);
    }
  }
}

TEST(GenesisEncoding, ContinuousGenesReachBothEnds) {
  const auto graph = testing::start_draws_graph();
  for (const std::uint32_t bits : {1u, 3u, 8u, 31u, 32u}) {
    const GenesisEncoding encoding(*graph, {3, 3, bits, 3, 3}, false);
    BitString low(encoding.length(), 0), high(encoding.length(), 1);
    EXPECT_EQ(encoding.quantile(low, 2), 0u);
    EXPECT_EQ(encoding.quantile(high, 2), 0xffffffffu);
  }
}

TEST(GenesisEncoding, ChildrenInheritTheExactValuesOfTheirParents) {
  const auto graph = testing::start_draws_graph();
  const GenesisEncoding encoding(*graph, {}, true);
  Derivation a = encoding.decode(BitString(encoding.length(), 0)), b = encoding.decode(BitString(encoding.length(), 1));
  a.draws[2] = 12345, b.draws[3] = 0x40000001;  // by hand, between the numbers of the strings
  BitString child = encoding.encode(a);
  const BitString other = encoding.encode(b);
  std::copy(other.begin() + static_cast<std::ptrdiff_t>(encoding.first_bit(3)), other.end(),
            child.begin() + static_cast<std::ptrdiff_t>(encoding.first_bit(3)));
  const Derivation made = encoding.inherit(child, a, b);
  EXPECT_EQ(made.draws[2], 12345u);
  EXPECT_EQ(made.draws[3], 0x40000001u);
}

TEST(GenesisEncoding, RefusesGenomesThatGrow) {
  const auto error_of = [](const GeneratorGraph& graph, const std::vector<std::uint32_t>& bits) -> std::string {
    try {
      GenesisEncoding(graph, bits, true);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(error_of(*testing::twig_graph(), {}), HasSubstr("rule Root has the slot Twig[0]"));
  EXPECT_THAT(error_of(*testing::start_draws_graph(), {8, 8}), HasSubstr("each of the 5 draws of rule Tree, got 2"));
  GeneratorGraph chooses = *testing::start_draws_graph();
  chooses.rules[0].variants.push_back(chooses.rules[0].variants[0]);
  EXPECT_THAT(error_of(chooses, {}), HasSubstr("a choice of 2 variants"));
  GeneratorGraph nothing = *testing::start_draws_graph();
  nothing.rules[0] = testing::make_rule("Tree", 0, {});
  EXPECT_THAT(error_of(nothing, {}), HasSubstr("no draws"));
}

}  // namespace
}  // namespace espalier
