#pragma once
// Appraiser: looks at candidates before a person does: whether they may be shown, what the targets make of them, and
// their features. Threads and models stay behind it.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/executor.h"
#include "breed/features.h"
#include "breed/viability.h"
#include "derivation/derivation.h"
#include "model/expand.h"
#include "score/objective.h"

namespace espalier {

struct Appraisal {
  bool viable = true;
  std::vector<std::string> reasons;  // why it is not
  double score = 0;                  // what the targets give, higher is better; 0 without targets
  std::vector<double> features;
  PerMeasure<double> measures;
};

class Appraiser {
 public:
  virtual ~Appraiser() = default;
  /// One appraisal each; the same for any number of threads.
  virtual std::vector<Appraisal> appraise(std::span<const Derivation* const> candidates) = 0;
  /// Of the features; empty where there are none.
  virtual const std::vector<std::string>& feature_names() const = 0;
  /// Scores tell candidates apart: there are targets.
  virtual bool has_targets() const { return false; }
};

/// Everybody is viable; features of the genome alone. Needs no model.
class GenomeAppraiser final : public Appraiser {
 public:
  explicit GenomeAppraiser(std::shared_ptr<const GeneratorGraph> graph) : graph_(std::move(graph)), features_(*graph_) {
    const auto first = features_.names().begin();
    names_.assign(first, first + static_cast<std::ptrdiff_t>(features_.genome_size()));
  }
  std::vector<Appraisal> appraise(std::span<const Derivation* const> candidates) override;
  const std::vector<std::string>& feature_names() const override { return names_; }

 private:
  std::shared_ptr<const GeneratorGraph> graph_;
  Features features_;
  std::vector<std::string> names_;
};

/// What there is to see of a candidate while it is judged; gone afterwards.
struct Sighting {
  const Derivation& derivation;
  const Model& model;  // with details
  const ViabilityReport& report;
  const std::vector<double>& features;
};

/// Expands candidates and looks at their models.
class ModelAppraiser final : public Appraiser {
 public:
  struct Settings {
    ViabilitySettings viability;
    /// Of candidates: what is larger counts as truncated, and is not viable. Smaller than for files: a first screen
    /// looks at dozens of models in a second.
    ExpandLimits limits = {
        .most_parts = 100'000, .most_turns = 1'000'000, .most_copies = 400'000, .make_materials = false};
    /// Is shown each viable candidate on the thread that judged it, before the targets are asked; several at a time. For
    /// who would grow the same model again. May be empty.
    std::function<void(const Sighting&)> onlooker = {};
  };

  /// `targets` may be null; what it does not accept is not viable. All references must outlive this. Throws Error for
  /// bad settings.
  ModelAppraiser(std::shared_ptr<const GeneratorGraph> graph, const MeshTable& meshes, const Settings& settings,
                 BatchScorer* targets, Executor& executor);
  ~ModelAppraiser() override;

  std::vector<Appraisal> appraise(std::span<const Derivation* const> candidates) override;
  const std::vector<std::string>& feature_names() const override { return features_.names(); }
  bool has_targets() const override { return targets_ != nullptr; }

 private:
  struct Worker;

  std::shared_ptr<const GeneratorGraph> graph_;
  Settings settings_;
  Viability viability_;
  Features features_;
  BatchScorer* targets_;
  Executor& executor_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace espalier
