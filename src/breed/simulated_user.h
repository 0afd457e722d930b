#pragma once
// SimulatedUser: somebody with a hidden favourite, who rates trees by how like it they look, not quite reliably. For
// measuring how many ratings a method of breeding costs. Knows genomes that are draws of the start rule alone.

#include <vector>

#include "base/random.h"
#include "derivation/derivation.h"

namespace espalier {

/// Mean absolute difference of the quantiles of two derivations' draws, as seen: of those of n values, between the
/// middles of their plateaus; of circular ones the shorter way round. Both have the same draws. 0..1; two random
/// ones: about 1/3.
double gene_distance(const GeneratorGraph& graph, const Derivation& a, const Derivation& b);

class SimulatedUser {
 public:
  /// What a click is worth, in distance. Ratings are clicks up and down from 0,
  /// which is what a random tree gets on average.
  static constexpr double kStep = 0.02, kUsual = 0.33;

  /// `noise`: scale of the Gumbel noise on distances; its standard deviation is 1.28 times that.
  SimulatedUser(const GeneratorGraph& graph, const Derivation& favourite, double noise, std::uint64_t seed)
      : graph_(graph), favourite_(favourite), noise_(noise), random_({seed, Purpose::test, 1u << 23, 0, 0}) {}

  double distance(const Derivation& tree) const { return gene_distance(graph_, tree, favourite_); }
  /// Whole clicks; asked twice of the same tree it may answer otherwise.
  double rate(const Derivation& tree);
  /// Uniform numbers of the user's own, for what else it decides.
  RandomStream& random() { return random_; }

 private:
  const GeneratorGraph& graph_;
  Derivation favourite_;
  double noise_;
  RandomStream random_;
};

}  // namespace espalier
