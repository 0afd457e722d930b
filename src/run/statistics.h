#pragma once
// Statistics of a handful of repetitions: what lies in the middle, how far they scatter, and whether two samples differ
// by more than chance would have it.

#include <cstddef>
#include <span>
#include <vector>

namespace espalier {

/// -infinity stands for a repetition that came to nothing: orders hold, and what cannot be told is not finite.
struct SampleSummary {
  std::size_t count = 0;
  double median = 0, mean = 0;
  double deviation = 0;         // standard deviation of the population that was sampled (n - 1); 0 of a single value
  double lower = 0, upper = 0;  // quartiles
  double min = 0, max = 0;

  double iqr() const { return upper - lower; }
};

/// At least one value, none of them NaN.
SampleSummary summarise(std::vector<double> values);

/// The value below which `share` (0 to 1) of an ascending sample lies, between two values in proportion: that of rank
/// 1 + share * (n - 1) (Hyndman and Fan 1996, type 7).
double quantile(std::span<const double> ascending, double share);

/// Mann and Whitney's rank test (1947), two-sided: how probable it is that two samples of one and the same distribution
/// lie at least as far apart as these. Exact, ties included, for up to 50 values together; beyond by the normal
/// distribution. Both samples have a value at least.
double rank_test(std::span<const double> a, std::span<const double> b);

/// Holm's correction (1979) of several tests made at once, in the order given: with all of them taken together, chance
/// alone brings any below a limit no more often than the limit says. The least is multiplied by how many there are, the
/// next by one less, and so on; none falls below a lesser one, or rises above 1.
std::vector<double> holm(std::span<const double> chances);

/// The least that rank_test can come to for samples of these sizes.
double least_rank_test(std::size_t a, std::size_t b);

}  // namespace espalier
