#pragma once
// GenesisEncoding: derivations of a grammar whose genome is the draws of its start rule, as strings of bits.
//
// A gene of b bits holds k in 0..2^b - 1, highest bit first, in Gray code if wanted. It stands for
//
//   a continuous draw: the quantile k / (2^b - 1), both ends of the range included, as in Genesis;
//   a circular one: k / 2^b;
//   one of n values: the value at the quantile (k + 1/2) / 2^b. Where n = 2^b that is value k.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

using BitString = std::vector<std::uint8_t>;  // 0 or 1 each

/// Why the genome of the graph is more than the draws of its start rule, in words that name the rule and the slot or
/// the choice; empty where it is not. A start rule without draws has no genome at all: that is said too.
std::string why_not_start_draws(const GeneratorGraph& graph);

class GenesisEncoding {
 public:
  /// `bits`: per draw of the start rule, 1..32; empty: log2 n for n values where that is whole, 8 else (more where n is
  /// larger than 64). Throws Error where why_not_start_draws says something, and for a list of another length.
  GenesisEncoding(const GeneratorGraph& graph, const std::vector<std::uint32_t>& bits, bool gray);

  std::size_t genes() const { return genes_.size(); }
  std::size_t length() const { return length_; }  // bits
  std::uint32_t bits_of(std::size_t gene) const { return genes_[gene].bits; }
  std::size_t first_bit(std::size_t gene) const { return genes_[gene].first; }

  std::uint32_t quantile(const BitString& string, std::size_t gene) const;
  /// The gene of the string becomes the one that is nearest to the quantile.
  void put(std::uint32_t quantile, std::size_t gene, BitString& string) const;

  BitString encode(const Derivation& derivation) const;
  /// A derivation with this detail seed.
  Derivation decode(const BitString& string, std::uint64_t detail_seed = 0) const;
  /// The child that a string is, of parents that strings were made of: genes that are as in a parent (the first, else
  /// the second) have that parent's very quantiles, which may lie between those that strings know.
  Derivation inherit(const BitString& string, const Derivation& first, const Derivation& second) const;

 private:
  struct Gene {
    DrawShape shape = DrawShape::continuous;
    std::uint32_t bits = 0;
    std::size_t first = 0;
  };
  bool same_gene(const BitString& a, const BitString& b, std::size_t gene) const;

  std::vector<Gene> genes_;
  std::size_t length_ = 0;
  bool gray_;
};

}  // namespace espalier
