#pragma once
// Exact draws from the posterior of the tiny graph, so that chains can begin where they shall stay, and the tests that
// follow from that: detailed balance of one step, and distributions after a few.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"
#include "derivation/chi_square.h"
#include "derivation/encode.h"
#include "search/deviation.h"
#include "search/tiny_posterior.h"

namespace espalier::testing {

/// u in 0..1 with the density exp(beta u), as a quantile of 32 bits.
inline std::uint32_t exact_draw(double beta, RandomStream& random) {
  const double u = std::log1p(random.next_unit() * std::expm1(beta)) / beta;
  return static_cast<std::uint32_t>(std::min(u * 0x1p32, 0x1p32 - 1));
}

class ExactPosterior {
 public:
  ExactPosterior(std::shared_ptr<const GeneratorGraph> graph, double beta, std::size_t most_genes = 1000)
      : graph_(std::move(graph)), beta_(beta), shares_(shares(tiny_posterior(*graph_, beta, most_genes))) {
    double sum = 0;
    for (const auto& [key, share] : shares_) {
      ends_.push_back(sum += share);
      derivations_.push_back(structure_of(key));
      EXPECT_EQ(test::key_of(*graph_, derivations_.back()), key);
      EXPECT_EQ(find_fault(*graph_, derivations_.back()), "");
    }
  }

  const std::map<std::string, double>& by_key() const { return shares_; }

  Derivation draw(RandomStream& random) const {
    const auto end = std::upper_bound(ends_.begin(), ends_.end(), random.next_unit() * ends_.back());
    Derivation derivation = derivations_[std::min<std::size_t>(end - ends_.begin(), derivations_.size() - 1)];
    for (std::uint32_t& draw : derivation.draws) draw = exact_draw(beta_, random);
    return derivation;
  }

 private:
  /// The inverse of key_of; draws are 0.
  Derivation structure_of(const std::string& key) const {
    Derivation derivation;
    std::size_t at = 0;
    append(key, at, derivation);
    EXPECT_EQ(at, key.size());
    return derivation;
  }
  void append(const std::string& key, std::size_t& at, Derivation& derivation) const {
    const std::size_t self = derivation.genes.size(), point = key.find('.', at), end = key.find(' ', at);
    GeneRecord gene;
    gene.edge = static_cast<EdgeId>(std::stoi(key.substr(at, point - at)));
    const std::size_t letters = key.find_first_of("OEFA ", point);
    gene.variant = static_cast<std::uint16_t>(std::stoi(key.substr(point + 1, letters - point - 1)));
    derivation.genes.push_back(gene);
    derivation.draws.resize(derivation.draws.size() + variant_of(*graph_, gene).draws.size());
    const std::size_t draws = derivation.draws.size();
    at = end + 1;
    std::size_t filled = 0;
    for (std::size_t i = letters; i < end; ++i) {
      derivation.slots.push_back(static_cast<SlotState>(std::string("OEFA").find(key[i])));
      filled += key[i] == 'F';
    }
    const std::size_t slots = derivation.slots.size();
    for (; filled > 0; --filled) append(key, at, derivation);
    derivation.genes[self].genes_below = static_cast<std::uint32_t>(derivation.genes.size() - self - 1);
    derivation.genes[self].slots_below = static_cast<std::uint32_t>(derivation.slots.size() - slots);
    derivation.genes[self].draws_below = static_cast<std::uint32_t>(derivation.draws.size() - draws);
  }

  std::shared_ptr<const GeneratorGraph> graph_;
  double beta_;
  std::map<std::string, double> shares_;
  std::vector<double> ends_;
  std::vector<Derivation> derivations_;
};

/// A derivation as a cell: its structure, and which of so many equal parts of 0..1 each draw lies in.
inline std::string cell_of(const GeneratorGraph& graph, const Derivation& derivation, std::uint32_t parts) {
  std::string cell = test::key_of(graph, derivation);
  for (const std::uint32_t draw : derivation.draws) {
    cell += static_cast<char>('0' + (std::uint64_t{draw} * parts >> 32));
  }
  return cell;
}

/// Transitions whose start is drawn from the distribution that a reversible chain keeps: of all that can be told apart,
/// every way is as likely as the way back. By cells, which say where; and by steps of a value, which say how far and
/// need few counts to notice a drift.
class Balance {
 public:
  void add(const std::string& from, const std::string& to) {
    if (from != to) count(std::min(from, to) + "|" + std::max(from, to), from < to);
  }
  void add_step(double from, double to) {
    if (from == to) return;
    count(std::to_string(std::ilogb(to - from)), from < to);
  }
  std::size_t pairs() const {
    return static_cast<std::size_t>(std::count_if(ways_.begin(), ways_.end(), counts));
  }
  /// Chi-square of the differences over its bound at 0.0005: given how often a pair was seen at all, the ways are a
  /// throw of a fair coin. Pairs that were rarely seen are left out.
  double excess() const {
    double chi2 = 0;
    for (const auto& way : ways_) {
      const double there = way.second.first, back = way.second.second;
      if (counts(way)) chi2 += (there - back) * (there - back) / (there + back);
    }
    return chi2 / test::chi_square_bound(static_cast<double>(pairs()));
  }

 private:
  using Ways = std::map<std::string, std::pair<int, int>>;
  static bool counts(const Ways::value_type& way) { return way.second.first + way.second.second >= 10; }
  void count(const std::string& pair, bool there) {
    auto& [forth, back] = ways_[pair];
    ++(there ? forth : back);
  }
  Ways ways_;
};

/// Pearson's chi-square of counts against probabilities over its bound at 0.0005; what is expected less than five times
/// is pooled.
inline double excess(const std::map<std::string, double>& probabilities, const std::map<std::string, int>& counts) {
  double total = 0, chi2 = 0, pooled = 0, pooled_count = 0, cells = 1;
  for (const auto& [name, count] : counts) {
    EXPECT_TRUE(probabilities.contains(name)) << name;
    total += count;
  }
  for (const auto& [name, probability] : probabilities) {
    const auto found = counts.find(name);
    const double count = found == counts.end() ? 0 : found->second, expected = probability * total;
    if (expected < 5) {
      pooled += expected, pooled_count += count;
    } else {
      chi2 += (count - expected) * (count - expected) / expected;
      ++cells;
    }
  }
  chi2 += (pooled_count - pooled) * (pooled_count - pooled) / std::max(pooled, 1.0);
  return chi2 / test::chi_square_bound(cells - 1);
}

}  // namespace espalier::testing
