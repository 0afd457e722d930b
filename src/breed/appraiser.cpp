#include "breed/appraiser.h"

#include "base/check.h"

namespace espalier {

std::vector<Appraisal> GenomeAppraiser::appraise(std::span<const Derivation* const> candidates) {
  std::vector<Appraisal> appraisals(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    appraisals[i].features = features_.of_genome(*graph_, *candidates[i]);
  }
  return appraisals;
}

struct ModelAppraiser::Worker {
  Expander expander;
  Model model;
  Viability::Scratch scratch;

  Worker(const GeneratorGraph& graph, const ExpandLimits& limits) : expander(graph, limits) {}
};

ModelAppraiser::ModelAppraiser(std::shared_ptr<const GeneratorGraph> graph, const MeshTable& meshes,
                               const Settings& settings, BatchScorer* targets, Executor& executor)
    : graph_(std::move(graph)),
      settings_(settings),
      viability_(meshes, settings.viability),
      features_(*graph_),
      targets_(targets),
      executor_(executor) {
  for (int i = 0; i < executor.workers(); ++i) workers_.push_back(std::make_unique<Worker>(*graph_, settings.limits));
}

ModelAppraiser::~ModelAppraiser() = default;

std::vector<Appraisal> ModelAppraiser::appraise(std::span<const Derivation* const> candidates) {
  std::vector<Appraisal> appraisals(candidates.size());
  executor_.for_each(candidates.size(), [&](std::size_t i, int which) {
    Worker& worker = *workers_[static_cast<std::size_t>(which)];
    worker.expander.expand(*candidates[i], ExpandTo::full, worker.model);
    const ViabilityReport report = viability_.judge(*candidates[i], worker.model, worker.scratch);
    Appraisal& appraisal = appraisals[i];
    appraisal.viable = report.viable;
    appraisal.reasons = report.reasons;
    appraisal.measures = report.measures;
    appraisal.features = features_.of(*graph_, *candidates[i], worker.model, report.measures);
    if (settings_.onlooker && report.viable)
      settings_.onlooker({*candidates[i], worker.model, report, appraisal.features});
  });
  if (!targets_) return appraisals;
  std::vector<const Derivation*> viable;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!appraisals[i].viable) continue;
    viable.push_back(candidates[i]);
    places.push_back(i);
  }
  std::vector<double> scores(viable.size());
  if (!viable.empty()) targets_->score(viable, scores);
  for (std::size_t k = 0; k < viable.size(); ++k) {
    Appraisal& appraisal = appraisals[places[k]];
    appraisal.score = scores[k];
    if (scores[k] != kNotAcceptable) continue;
    appraisal.score = 0;
    appraisal.viable = false;
    appraisal.reasons.emplace_back("a target does not accept it");
  }
  return appraisals;
}

}  // namespace espalier
