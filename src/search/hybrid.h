#pragma once
// Hybrid: SOSMC for the start, then the genetic algorithm, then RJMCMC, each beginning with what the one before found
// (the future work of ShapeGenetics 2017, section 9). SOSMC hands over after its first sweeps or
// so many evaluations, the genetic algorithm when it has stalled, counted in evaluations.

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "search/engine.h"
#include "search/hybrid_settings.h"

namespace espalier {

class HybridEngine final : public Engine {
 public:
  enum class Stage : std::uint8_t { start, middle, end };

  /// Throws Error for bad settings.
  HybridEngine(const SearchProblem& problem, const HybridSettings& settings);
  ~HybridEngine() override;

  /// Throws what the engines throw.
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluations_before_ + engine_->evaluations(); }
  std::span<const Individual> population() const override { return engine_->population(); }
  const Individual& best() const override;
  /// Of all three, each name with its engine's before it.
  std::vector<NamedCount> diagnostics() const override;
  /// `stage`, and those of all three, each with its engine's name before it: nothing to tell of those that do not run.
  std::vector<NamedGauge> gauges() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  Stage stage() const { return stage_; }

 private:
  std::unique_ptr<Engine> make_engine(Stage stage, std::vector<Individual> founders) const;
  std::uint32_t lane_of(Stage stage) const;
  bool is_over() const;
  void hand_over();
  std::vector<Individual> heirs(std::size_t most);
  void score(const std::vector<std::size_t>& which, std::vector<Individual>& individuals);
  std::string own_fingerprint() const;

  SearchProblem problem_;
  HybridSettings settings_;
  Stage stage_ = Stage::start;
  std::unique_ptr<Engine> engine_;
  std::vector<Individual> founders_;        // of the engine that runs
  std::uint64_t steps_ = 0;
  std::uint64_t evaluations_before_ = 0;    // by engines that are done, and at handing over
  double risen_to_ = 0;                     // the best when it last rose
  std::uint64_t risen_at_ = 0;              // evaluations then
  std::array<std::vector<NamedCount>, 3> counts_;  // of engines that are done; of others zeros
  std::array<std::vector<NamedGauge>, 3> silent_;  // the gauges of engines that do not run
  Individual best_;
};

}  // namespace espalier
