#pragma once
// Diversity: how far apart two derivations are, and an archive of good ones that are pairwise far apart.

#include <cstdint>
#include <span>
#include <vector>

#include "derivation/derivation.h"
#include "derivation/sweep.h"
#include "search/engine.h"

namespace espalier {

/// A derivation seen from afar: its genes by the place where they stand. `place` hashes the way of slots and variants that
/// leads to the gene, its own variant included.
struct DerivationSketch {
  struct Gene {
    std::uint64_t place;
    std::uint32_t draw;  // first of its quantiles in `draws`
    std::uint16_t edge, variant;

    bool operator==(const Gene&) const = default;
  };
  std::vector<Gene> genes;  // by place
  std::vector<std::uint32_t> draws;
};

/// In O(n log n); reuses the storage of `sketch`.
void make_sketch(const GeneratorGraph& graph, const Derivation& derivation, GeneSweep& sweep, DerivationSketch& sketch);

/// 1 - (sum over shared places of 1 - mean |difference of quantiles|) / (number of places in either). In [0, 1]: 0 for
/// equal derivations, 1 where not even the start gene agrees. Angles differ the short way round.
double distance(const GeneratorGraph& graph, const DerivationSketch& a, const DerivationSketch& b);
double distance(const GeneratorGraph& graph, const Derivation& a, const Derivation& b);

/// Keeps the best of all individuals offered that are pairwise at least `least_distance` apart: a newcomer replaces those
/// too near it that are worse, and is turned away if one too near is as good. A function of what was offered, in order.
class DiverseArchive {
 public:
  DiverseArchive(const GeneratorGraph& graph, std::size_t size, double least_distance);

  /// `population` is sorted, best first.
  void offer(std::span<const Individual> population);
  /// Best first.
  const std::vector<Individual>& members() const { return members_; }

 private:
  void offer(const Individual& individual);

  const GeneratorGraph& graph_;
  std::size_t size_;
  double least_distance_;
  std::vector<Individual> members_;
  std::vector<DerivationSketch> sketches_;  // of the members
  DerivationSketch sketch_;
  GeneSweep sweep_;
};

}  // namespace espalier
