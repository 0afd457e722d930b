#pragma once
// Limit: what one measure may be: a soft ramp that costs score, and hard bounds beyond which a model is rejected.

#include <optional>
#include <string>
#include <string_view>

#include "score/measure.h"

namespace espalier {

/// The score loses weight * S, where S (score/smootherstep.h) rises from 0 at `from` to 1 at `to`; with from > to it is
/// small values that cost: S is 1 up to `to` and 0 beyond `from`. Values below `min` or above `max` are rejected.
struct Limit {
  std::optional<double> min = std::nullopt, max = std::nullopt;
  double from = 0, to = 0, weight = 0;

  bool accepts(double value) const { return !(min && value < *min) && !(max && value > *max); }
  /// What the ramp costs, >= 0.
  double cost(double value) const;
  bool operator==(const Limit&) const = default;
};
using Limits = PerMeasure<Limit>;  // a Limit{} asks nothing

/// Throws Error ("limits.height: ...") unless all is finite, min <= max, weight >= 0, and from != to where
/// weight > 0.
void validate(Measure measure, const Limit& limit);

/// The length terms of the papers' scores, as limits on genes. `genes_min` and `genes_max` are the hard ones.
///   length-2016: 0.2 * S(40, 100)               (Haubenwallner et al. 2016, eq. 4, with the values of section 4.2)
///   length-2017: 0.1 * S(genes_min, genes_max)  (the experiments of ShapeGenetics 2017: the ramp spans what is
///   allowed)
/// Throws Error for another name.
Limit length_term(std::string_view preset, double genes_min, double genes_max);

/// "4.2 m", "57 genes", "1 gene"; "0.43" for balance.
std::string with_unit(Measure measure, double value);
/// "height 4.3 m: 0.3 m over 4 m, costs 0.12"; only the first part where the ramp costs nothing.
std::string describe(Measure measure, const Limit& limit, double value);
/// "height 7.1 m is above max 6 m"; empty where the value is accepted.
std::string describe_rejection(Measure measure, const Limit& limit, double value);
/// "at least 2 m", "at most 6 m", "2 to 6 m"; empty where nothing is rejected.
std::string describe_bounds(Measure measure, const Limit& limit);

}  // namespace espalier
