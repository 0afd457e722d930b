#include "search/genesis_encoding.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"

namespace espalier {
namespace {

constexpr std::uint64_t kTop = 0xffffffff;  // the highest quantile

std::uint32_t default_bits(const DrawComponent& draw) {
  if (draw.shape != DrawShape::discrete || draw.values < 2) return 8;
  if (std::has_single_bit(draw.values)) return static_cast<std::uint32_t>(std::countr_zero(draw.values));
  // Four times as many numbers as values, at least: none is then more than a quarter likelier than another.
  return std::clamp(static_cast<std::uint32_t>(std::bit_width(draw.values)) + 2, 8u, 32u);
}

std::uint64_t to_gray(std::uint64_t k) { return k ^ k >> 1; }
std::uint64_t from_gray(std::uint64_t g) {
  for (int shift = 1; shift < 64; shift *= 2) g ^= g >> shift;
  return g;
}

}  // namespace

std::string why_not_start_draws(const GeneratorGraph& graph) {
  const Rule& rule = graph.rules[graph.start()];
  if (!rule.slots.empty()) {
    return fmt::format("rule {} has the slot {}: genes grow below the start rule", rule.name, rule.slots[0].name);
  }
  if (rule.variants.size() > 1) {
    return fmt::format("rule {} has a choice of {} variants", rule.name, rule.variants.size());
  }
  if (rule.draws.empty()) return fmt::format("rule {} has no draws: there is nothing to breed", rule.name);
  return "";
}

GenesisEncoding::GenesisEncoding(const GeneratorGraph& graph, const std::vector<std::uint32_t>& bits, bool gray)
    : gray_(gray) {
  const std::string why_not = why_not_start_draws(graph);
  if (!why_not.empty()) {
    throw Error(fmt::format("grammar {}: bit strings need a genome that is the draws of the start rule alone, but {}",
                            graph.name, why_not));
  }
  const std::vector<DrawComponent>& draws = graph.rules[graph.start()].draws;
  if (!bits.empty() && bits.size() != draws.size()) {
    throw Error(fmt::format("bits must list one number for each of the {} draws of rule {}, got {}", draws.size(),
                            graph.rules[graph.start()].name, bits.size()));
  }
  for (std::size_t i = 0; i < draws.size(); ++i) {
    genes_.push_back({draws[i].shape, bits.empty() ? default_bits(draws[i]) : bits[i], length_});
    length_ += genes_.back().bits;
  }
}

std::uint32_t GenesisEncoding::quantile(const BitString& string, std::size_t gene) const {
  const Gene& g = genes_[gene];
  std::uint64_t k = 0;
  for (std::uint32_t bit = 0; bit < g.bits; ++bit) k = k << 1 | string[g.first + bit];
  if (gray_) k = from_gray(k);
  const std::uint64_t most = (std::uint64_t{1} << g.bits) - 1;
  if (g.shape == DrawShape::continuous) return static_cast<std::uint32_t>((k * kTop + most / 2) / most);
  const std::uint64_t low = k << (32 - g.bits);
  if (g.shape == DrawShape::circular || g.bits == 32) return static_cast<std::uint32_t>(low);
  return static_cast<std::uint32_t>(low + (std::uint64_t{1} << (31 - g.bits)));
}

void GenesisEncoding::put(std::uint32_t quantile, std::size_t gene, BitString& string) const {
  const Gene& g = genes_[gene];
  const std::uint64_t most = (std::uint64_t{1} << g.bits) - 1;
  std::uint64_t k = 0;
  if (g.shape == DrawShape::continuous) {
    k = (quantile * most + kTop / 2) / kTop;
  } else if (g.shape == DrawShape::circular) {
    k = (quantile + (g.bits == 32 ? 0 : std::uint64_t{1} << (31 - g.bits))) >> (32 - g.bits) & most;
  } else {
    k = quantile >> (32 - g.bits);
  }
  if (gray_) k = to_gray(k);
  for (std::uint32_t bit = g.bits; bit-- > 0; k >>= 1) string[g.first + bit] = k & 1;
}

BitString GenesisEncoding::encode(const Derivation& derivation) const {
  CHECK(derivation.draws.size() == genes_.size());
  BitString string(length_);
  for (std::size_t i = 0; i < genes_.size(); ++i) put(derivation.draws[i], i, string);
  return string;
}

Derivation GenesisEncoding::decode(const BitString& string, std::uint64_t detail_seed) const {
  CHECK(string.size() == length_);
  Derivation derivation;
  derivation.genes.push_back({});
  derivation.detail_seed = detail_seed;
  for (std::size_t i = 0; i < genes_.size(); ++i) derivation.draws.push_back(quantile(string, i));
  return derivation;
}

bool GenesisEncoding::same_gene(const BitString& a, const BitString& b, std::size_t gene) const {
  const auto first = static_cast<std::ptrdiff_t>(genes_[gene].first);
  return std::equal(a.begin() + first, a.begin() + first + genes_[gene].bits, b.begin() + first);
}

Derivation GenesisEncoding::inherit(const BitString& string, const Derivation& first, const Derivation& second) const {
  Derivation child = decode(string, first.detail_seed);
  const BitString a = encode(first), b = encode(second);
  for (std::size_t i = 0; i < genes_.size(); ++i) {
    if (same_gene(string, a, i)) {
      child.draws[i] = first.draws[i];
    } else if (same_gene(string, b, i)) {
      child.draws[i] = second.draws[i];
    }
  }
  return child;
}

}  // namespace espalier
