#pragma once
// Sweep: a scene searched with every combination of some settings, with the same seeds and the same budget; which
// combination does best, and how much each setting matters. Layout of the folder: docs/comparing.md.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "run/compare_summary.h"
#include "run/contest_files.h"
#include "run/contest_progress.h"
#include "run/contest_result.h"
#include "run/sweep_plan.h"

namespace espalier {

inline constexpr const char* kSweepMarker = "sweep.json";

struct SweepRequest {
  Contest contest;  // a variant per combination
  std::vector<VariedSetting> varied;
  std::vector<std::vector<std::size_t>> combinations;
  bool curves = false;
  std::string command;
  std::string out;
  int threads = 0;
  const std::atomic<bool>* stop = nullptr;
  ContestObserver* observer = nullptr;  // may be null
};

struct SweepCombination {
  std::vector<std::optional<ContestOutcome>> searches;  // by seed; without derivations
  std::optional<SampleSummary> scores;                  // over the seeds that count
  double chance = 1;                                    // rank_test against the best combination
};

/// A value of a setting, over all combinations that have it: of their medians. One that came to nothing counts as the
/// worst.
struct SweepEffect {
  std::string value;
  std::optional<SampleSummary> medians;  // nothing: no combination with it was searched
  std::size_t nothing = 0;               // combinations without a median
};

struct SweepResult : ContestResult {
  std::vector<SweepCombination> combinations;
  std::vector<std::size_t> ranking;               // of combinations, highest median first
  std::vector<std::vector<SweepEffect>> effects;  // by setting, by value
  std::vector<std::size_t> counted;               // seeds that all completed; none: each by what it has
};

/// Nothing if it was stopped before there was any result; then no folder is left behind. Throws Error.
std::optional<SweepResult> sweep_settings(const SweepRequest& request, MeshSource& source);

/// Fills in scores, chances, ranking and effects from the searches (sweep_summary.cpp).
void summarise_sweep(const SweepRequest& request, SweepResult& result);
/// How far the medians of a setting's values lie apart. Nothing: fewer than two values were searched, or under one of
/// them most came to nothing.
std::optional<double> effect_of(const std::vector<SweepEffect>& values);

/// Of a combination's searches, step by step: what `value` gives of the last row at or before each of `at`. There are
/// points only where every search has a value: none where one failed.
CompareCurve sweep_curve(const SweepResult& result, std::size_t combination, const std::vector<double>& at,
                         double (*spent)(const StepReport&), double (*value)(const StepReport&));
/// Steps to tell of: all of a few hundred, else as axis_points.
std::vector<double> sweep_steps(const SweepResult& result, const std::vector<std::size_t>& combinations);

/// Files of the folder, as text (sweep_files.cpp, sweep_page.cpp).
std::string sweep_csv(const SweepRequest& request, const SweepResult& result);
std::string sweep_effects_csv(const SweepRequest& request, const SweepResult& result);
std::string sweep_curves_csv(const SweepRequest& request, const SweepResult& result);
std::string sweep_json(const SweepRequest& request, const SweepResult& result);

struct SweepPageParts {
  std::string settings;  // of the best
  const Picture* picture = nullptr;
  const ContestBest* best = nullptr;
  const InputFiles* inputs = nullptr;
};
std::string sweep_page(const SweepRequest& request, const SweepResult& result, const SweepPageParts& parts);

}  // namespace espalier
