#pragma once
// Compare: variants of a scene with the same seeds and the same budget, searched side by side; what came of it as
// numbers, tables, files and a page. Layout of the folder: docs/comparing.md.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "run/compare_summary.h"
#include "run/contest_files.h"
#include "run/contest_progress.h"
#include "run/contest_result.h"

namespace espalier {

inline constexpr const char* kCompareMarker = "compare.json";

struct CompareRequest {
  Contest contest;            // at most ContestSetups::kMostKept variants
  std::vector<double> marks;  // ascending, the budget as the last
  std::string command;        // as one would give it again, for the page
  std::string out;            // folder to make or replace
  int threads = 0;
  double slice_seconds = 0.25;
  const std::atomic<bool>* stop = nullptr;
  ContestObserver* observer = nullptr;  // may be null
};

struct CompareResult : ContestResult {
  CompareOutcomes outcomes;  // without what is large
  CompareSummary summary;
  std::vector<std::optional<ContestBest>> bests;  // by variant
};

/// Nothing if it was stopped before there was any result; then no folder is left behind. Throws Error.
std::optional<CompareResult> compare_variants(const CompareRequest& request, MeshSource& source);

/// Files of the folder, as text (compare_files.cpp).
std::string compare_csv(const Contest& contest, const CompareResult& result);
std::string compare_summary_csv(const Contest& contest, const CompareResult& result);
std::string compare_reach_csv(const Contest& contest, const CompareResult& result);
std::string compare_searches_csv(const Contest& contest, const CompareResult& result);
std::string compare_json(const Contest& contest, const CompareResult& result);

/// "no seed was completed: these are of seed 1, cut short after 0.5 s". Empty: nobody stopped it.
std::string interruption_in_words(const Contest& contest, const CompareResult& result);
/// What follows the name of the first at a mark: "; not told apart from it: smc, ga", or ", apart from all others".
std::string told_apart_in_words(const Contest& contest, const CompareMark& mark);

}  // namespace espalier
