#pragma once
// Objective: the weighted sum of a few targets; what a search maximises. Immutable once built, shared by all threads,
// each with a scratch of its own.

#include <memory>
#include <vector>

#include "score/target.h"

namespace espalier {

class Objective {
 public:
  /// The memory of one thread: one entry per target.
  class Scratch {
   public:
    explicit Scratch(const Objective& objective);

   private:
    friend class Objective;
    std::vector<std::unique_ptr<TargetScratch>> targets_;
    std::vector<double> scores_;
  };

  /// Adds weight * target. `weight` must be finite and >= 0 (a target says itself what it avoids); throws Error.
  void add(std::unique_ptr<const Target> target, double weight = 1);

  std::size_t size() const { return targets_.size(); }
  const Target& target(std::size_t i) const { return *targets_[i].target; }
  double weight(std::size_t i) const { return targets_[i].weight; }

  /// What the model must have been expanded to: the most that any target reads.
  TargetView view() const;

  /// -infinity where any target rejects the model, whatever its weight.
  double score(const Derivation& derivation, const Model& model, Scratch& scratch) const;
  double optimum() const;
  Explanation explain(const Derivation& derivation, const Model& model, Scratch& scratch) const;
  /// What score() rejected with this scratch, by hard bound; the same entries for every scratch.
  std::vector<Rejections> rejections(const Scratch& scratch) const;

 private:
  struct Entry {
    std::unique_ptr<const Target> target;
    double weight;
  };
  std::vector<Entry> targets_;
};

}  // namespace espalier
