#pragma once
// SceneScorer: scores batches on an executor, one expander, model and scratch per worker.

#include <string>
#include <vector>

#include "base/executor.h"
#include "model/expand.h"
#include "score/combined_objective.h"
#include "score/objective.h"

namespace espalier {

class SceneScorer final : public BatchScorer {
 public:
  /// All three must outlive it.
  SceneScorer(const GeneratorGraph& graph, const Objective& objective, Executor& executor);

  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override;
  double optimum() const override { return objective_.optimum(); }
  std::string describe_rejections() const override;
  /// What was rejected so far, by hard limit of the objective.
  std::vector<Rejections> rejections() const;
  /// Counts in what an equal scorer had rejected: `before` are its rejections(), names and bounds aside.
  void count_in(std::vector<Rejections> before) { before_ = std::move(before); }
  /// The score of one derivation taken apart.
  Explanation explain(const Derivation& derivation);

 private:
  struct Worker {
    Expander expander;
    Model model;
    Objective::Scratch scratch;
  };

  const Model& expand(const Derivation& derivation, Worker& worker) const;

  const Objective& objective_;
  Executor& executor_;
  TargetView view_;
  std::vector<Worker> workers_;
  std::vector<Rejections> before_;  // of an earlier scorer; empty: there was none
};

}  // namespace espalier
