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

  /// What is remembered of one state of a search: its parts, and what targets make of them. Of one thread at a time.
  class Session {
   public:
    explicit Session(const Objective& objective);

    /// The state is now the derivation of this model.
    void begin(const Model& state);
    /// The state is now what was scored last, which must have been acceptable.
    void commit();
    /// For tests: all targets that have sessions scored the last model by its difference from the state.
    bool counted_change() const;

   private:
    friend class Objective;
    std::vector<std::unique_ptr<TargetSession>> targets_;  // null: scored as a whole
    std::vector<Instance> state_;
    // Of what was scored last: how it differs from the state.
    bool scored_ = false;
    std::size_t first_ = 0, removed_ = 0;
    std::vector<Instance> added_;
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
  /// The very same, got by the difference from the session's state where targets can.
  double score(const Derivation& derivation, const Model& model, Scratch& scratch, Session& session) const;
  /// The most memory that the targets' parts of one session take, in bytes; 0: sessions are of no use.
  std::size_t session_bytes() const;
  /// 0 where no bound is known for a target of some weight.
  double optimum() const;
  Explanation explain(const Derivation& derivation, const Model& model, Scratch& scratch) const;
  /// What score() rejected with this scratch, by hard bound; the same entries for every scratch.
  std::vector<Rejections> rejections(const Scratch& scratch) const;

 private:
  struct Entry {
    std::unique_ptr<const Target> target;
    double weight;
  };
  template <class ScoreTarget>
  double sum_up(Scratch& scratch, const ScoreTarget& score_target) const;

  std::vector<Entry> targets_;
};

}  // namespace espalier
