#pragma once
// Diversity: an archive of good individuals whose models are pairwise far apart.

#include <span>
#include <vector>

#include "run/model_sketch.h"
#include "search/engine.h"

namespace espalier {

/// Keeps the best of all individuals offered that are pairwise at least `least_distance` apart (see ModelSketch): a
/// newcomer replaces those too near it that are worse, and is turned away if one too near is as good. A function of
/// what was offered, in order.
class DiverseArchive {
 public:
  DiverseArchive(ModelSketcher sketcher, std::size_t size, double least_distance);

  /// `population` is sorted, best first. Of equal scores in a row only the first is looked at; of unfinished
  /// individuals none, unless they are `open` as a matter of course.
  void offer(std::span<const Individual> population, bool open = false);
  /// Takes the place of the members; `members` are those of an equal archive, which goes on with them.
  void restore(std::vector<Individual> members);
  std::size_t capacity() const { return size_; }
  /// Best first.
  const std::vector<Individual>& members() const { return members_; }
  /// Those at least `least_distance` from `derivation` too, one less than the archive's size at most.
  std::vector<Individual> apart_from(const Derivation& derivation);
  /// The mean distance of any two members, in [0, 1]; 0 where there are fewer than two.
  double spread() const;
  /// The same of any individuals.
  double spread_of(std::span<const Individual> individuals);

 private:
  void offer(const Individual& individual);

  ModelSketcher sketcher_;
  std::size_t size_;
  double least_distance_;
  std::vector<Individual> members_;
  std::vector<ModelSketch> sketches_;  // of the members
  ModelSketch sketch_;
};

}  // namespace espalier
