#pragma once
// SceneScorer: scores batches on an executor, one expander, model and scratch per worker. Sessions keep what targets
// remember of a state; they are of use where a target has sessions (volumes), and share a budget of memory.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/executor.h"
#include "model/expand.h"
#include "score/combined_objective.h"
#include "score/objective.h"

namespace espalier {

/// For all sessions of a scorer at one time; chains beyond it have none. 50 chains on a grid of 100 x 200 x 100 voxels
/// take 192 MB at most.
inline constexpr std::size_t kSessionBytes = std::size_t{1} << 30;

class SceneScorer final : public BatchScorer {
 public:
  /// All three must outlive it.
  SceneScorer(const GeneratorGraph& graph, const Objective& objective, Executor& executor,
              std::size_t session_bytes = kSessionBytes);

  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override;
  std::unique_ptr<ScoreSession> make_session() override;
  void score_proposals(std::span<const ScoreProposal> proposals, std::span<double> scores) override;
  double optimum() const override { return objective_.optimum(); }
  /// Where nothing but guiding curves is asked for.
  std::unique_ptr<GrowthScorer> make_growth_scorer() override;
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
  class Session;

  const Model& expand(const Derivation& derivation, Worker& worker) const;

  const GeneratorGraph& graph_;
  const Objective& objective_;
  Executor& executor_;
  TargetView view_;
  std::vector<Worker> workers_;
  std::size_t bytes_left_;          // for sessions
  std::vector<Vec3> expected_;      // directions per rule, once somebody needs them
  std::vector<Rejections> before_;  // of an earlier scorer; empty: there was none
};

}  // namespace espalier
