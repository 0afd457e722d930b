#include "run/scene_scorer.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"
#include "score/curve_growth.h"
#include "score/curve_target.h"
#include "score/expected_direction.h"
#include "score/limit_target.h"

namespace espalier {
namespace {

void add(const std::vector<Rejections>& more, std::vector<Rejections>& all) {
  CHECK(more.size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (more[i].count == 0) continue;
    all[i].lowest = all[i].count == 0 ? more[i].lowest : std::min(all[i].lowest, more[i].lowest);
    all[i].highest = all[i].count == 0 ? more[i].highest : std::max(all[i].highest, more[i].highest);
    all[i].count += more[i].count;
  }
}

/// What engines see to by themselves: a least and a greatest number of genes.
bool only_counts_genes(const LimitTarget& limits) {
  return std::all_of(limits.measures().begin(), limits.measures().end(), [&](Measure measure) {
    return measure == Measure::genes && limits.limits()[measure].weight == 0;
  });
}

}  // namespace

class SceneScorer::Session final : public ScoreSession {
 public:
  Session(SceneScorer& scorer, std::size_t bytes) : scorer_(scorer), bytes_(bytes), session(scorer.objective_) {
    scorer_.bytes_left_ -= bytes_;
  }
  ~Session() override { scorer_.bytes_left_ += bytes_; }

  void begin(const Derivation& state) override { session.begin(scorer_.expand(state, scorer_.workers_.front())); }
  void commit() override { session.commit(); }

 private:
  SceneScorer& scorer_;
  std::size_t bytes_;

 public:
  Objective::Session session;
};

SceneScorer::SceneScorer(const GeneratorGraph& graph, const Objective& objective, Executor& executor,
                         std::size_t session_bytes)
    : graph_(graph),
      objective_(objective),
      executor_(executor),
      view_(objective.view()),
      bytes_left_(session_bytes) {
  workers_.reserve(static_cast<std::size_t>(executor.workers()));
  for (int i = 0; i < executor.workers(); ++i) {
    // No target looks at materials.
    workers_.push_back({Expander(graph, {.make_materials = false}), Model(), Objective::Scratch(objective)});
  }
}

const Model& SceneScorer::expand(const Derivation& derivation, Worker& worker) const {
  switch (view_) {
    case TargetView::genes: break;  // the model stays empty
    case TargetView::bones: worker.expander.expand(derivation, ExpandTo::bones, worker.model); break;
    case TargetView::parts: worker.expander.expand(derivation, ExpandTo::parts, worker.model); break;
    case TargetView::full: worker.expander.expand(derivation, ExpandTo::full, worker.model); break;
  }
  return worker.model;
}

void SceneScorer::score(std::span<const Derivation* const> derivations, std::span<double> scores) {
  CHECK(derivations.size() == scores.size());
  executor_.for_each(derivations.size(), [&](std::size_t i, int w) {
    Worker& worker = workers_[static_cast<std::size_t>(w)];
    scores[i] = objective_.score(*derivations[i], expand(*derivations[i], worker), worker.scratch);
  });
}

std::unique_ptr<ScoreSession> SceneScorer::make_session() {
  const std::size_t bytes = objective_.session_bytes();
  if (bytes == 0 || bytes > bytes_left_) return nullptr;
  return std::make_unique<Session>(*this, bytes);
}

std::unique_ptr<GrowthScorer> SceneScorer::make_growth_scorer() {
  const CurveTarget* curves = nullptr;
  double weight = 1;
  for (std::size_t i = 0; i < objective_.size(); ++i) {
    const Target& target = objective_.target(i);
    const auto* const limits = dynamic_cast<const LimitTarget*>(&target);
    if (limits && only_counts_genes(*limits)) continue;
    if (curves || !(curves = dynamic_cast<const CurveTarget*>(&target))) return nullptr;
    weight = objective_.weight(i);
  }
  if (!curves) return nullptr;
  constexpr std::uint64_t kSeed = 1;  // of the grammar's, not of a search's
  if (expected_.empty()) expected_ = expected_directions(graph_, kSeed);
  return std::make_unique<CurveGrowth>(graph_, curves->cost(), weight, expected_);
}

void SceneScorer::score_proposals(std::span<const ScoreProposal> proposals, std::span<double> scores) {
  CHECK(proposals.size() == scores.size());
  executor_.for_each(proposals.size(), [&](std::size_t i, int w) {
    Worker& worker = workers_[static_cast<std::size_t>(w)];
    const Derivation& derivation = *proposals[i].derivation;
    const Model& model = expand(derivation, worker);
    auto* const own = static_cast<Session*>(proposals[i].session);
    scores[i] = own == nullptr ? objective_.score(derivation, model, worker.scratch)
                               : objective_.score(derivation, model, worker.scratch, own->session);
  });
}

std::vector<Rejections> SceneScorer::rejections() const {
  std::vector<Rejections> all = objective_.rejections(workers_.front().scratch);
  for (std::size_t w = 1; w < workers_.size(); ++w) add(objective_.rejections(workers_[w].scratch), all);
  if (!before_.empty()) add(before_, all);
  return all;
}

std::string SceneScorer::describe_rejections() const {
  std::string text;
  for (const Rejections& r : rejections()) {
    if (r.count == 0) continue;
    text += fmt::format("{}limits.{} allows {}; {} had {:.6g} to {:.6g}", text.empty() ? "" : "; ", r.name, r.bound,
                        r.count, r.lowest, r.highest);
    if (!r.unit.empty()) text += " " + r.unit;
  }
  return text;
}

Explanation SceneScorer::explain(const Derivation& derivation) {
  Worker& worker = workers_.front();
  return objective_.explain(derivation, expand(derivation, worker), worker.scratch);
}

}  // namespace espalier
