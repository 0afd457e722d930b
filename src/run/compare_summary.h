#pragma once
// What a comparison comes to: curves over time and over evaluations, scores at marks, who is ahead and whether chance
// would do for that, and how soon each reached what the others ended with. Pure: outcomes in, numbers out.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "run/contest.h"
#include "run/statistics.h"

namespace espalier {

/// The best of every search of a variant at common points of one axis. A mean or median stands where every counted
/// search has a score: nowhere do a few searches speak for all.
struct CompareCurve {
  std::vector<std::vector<std::optional<double>>> searches;  // [seed][point], also of searches that do not count
  std::vector<std::optional<SampleSummary>> points;
};

struct CompareAxis {
  Effort effort = Effort::seconds;
  std::vector<double> at;            // ascending
  std::vector<CompareCurve> curves;  // by variant
};

/// Variants at a moment. No score yet is below every score.
struct CompareMark {
  double at = 0;
  std::vector<SampleSummary> scores;     // by variant
  std::vector<std::size_t> ranking;      // variants, highest median first
  /// By variant: rank_test against the first of the ranking, by Holm's correction for the others; its own is 1.
  std::vector<double> chance;
};

/// The least that a mark's chance can come to: of so many seeds, and variants.
double least_chance(std::size_t seeds, std::size_t variants);

/// How soon a variant came up to a score.
struct CompareReach {
  std::size_t reached = 0, of = 0;  // searches
  std::optional<double> median;     // what was spent until then; nothing: less than half of them did
};

struct CompareSummary {
  std::vector<std::size_t> counted;  // indices of the seeds that all variants completed; statistics are over these
  bool partial = false;              // there were none: they are over what was cut short
  Effort effort = Effort::seconds;   // of the budget and the marks
  std::array<CompareAxis, 2> axes;   // seconds, evaluations
  std::vector<CompareMark> marks;
  /// [effort][who][whose]: how soon `who` reached the median with which `whose` ended.
  std::array<std::vector<std::vector<CompareReach>>, 2> reach;
  std::vector<double> evaluations_per_second;  // by variant, of its counted searches together

  const CompareAxis& axis(Effort which) const { return axes[static_cast<std::size_t>(which)]; }
};

/// outcomes[variant][seed]; nothing where a search was not begun. `marks` ascend, within the budget.
using CompareOutcomes = std::vector<std::vector<std::optional<ContestOutcome>>>;
CompareSummary summarise_contest(const CompareOutcomes& outcomes, const SceneBudget& budget,
                                 const std::vector<double>& marks);

/// A few round ones, and the budget itself.
std::vector<double> default_marks(const SceneBudget& budget);
/// "1,5,30": ascending, within the budget, which is added as the last. Throws Error.
std::vector<double> parse_marks(std::string_view text, const SceneBudget& budget);

/// Points of an axis from `first` to `last` > 0: half of them evenly spaced, half evenly by ratios, `marks` among them.
std::vector<double> axis_points(Effort effort, double first, double last, const std::vector<double>& marks);

}  // namespace espalier
