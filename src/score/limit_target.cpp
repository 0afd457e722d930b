#include "score/limit_target.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/check.h"
#include "derivation/sample.h"

namespace espalier {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Tally {
  std::uint64_t count = 0;
  double lowest = kInfinity, highest = -kInfinity;
};

struct LimitScratch final : TargetScratch {
  Gauge::Scratch gauge;
  PerMeasure<double> values;
  PerMeasure<Tally> rejected;
};

LimitScratch& scratch_of(TargetScratch* scratch) {
  DCHECK(dynamic_cast<LimitScratch*>(scratch));
  return static_cast<LimitScratch&>(*scratch);
}

PerMeasure<bool> limited(const Limits& limits) {
  PerMeasure<bool> wanted;
  for (const Measure measure : kAllMeasures) {
    validate(measure, limits[measure]);
    wanted[measure] = limits[measure] != Limit{};
  }
  return wanted;
}

/// Growth never takes genes away; all else may still rise or fall, since what open slots show goes when they are
/// decided.
bool may_still_be_accepted(Measure measure, const Limit& limit, double value) {
  const bool only_rises = measure == Measure::genes || measure == Measure::depth;
  return !only_rises || !limit.max || value <= *limit.max;
}

}  // namespace

LimitTarget::LimitTarget(const Limits& limits, const MeshTable& meshes, VolumeView view)
    : limits_(limits), shown_(view), gauge_(meshes, view, limited(limits)) {
  for (const Measure measure : kAllMeasures) {
    const Limit& limit = limits[measure];
    if (limit == Limit{}) continue;
    measures_.push_back(measure);
    may_reject_ |= limit.min.has_value() || limit.max.has_value();
  }
  if (limits[Measure::volume] == Limit{}) return;
  for (const std::string& file : gauge_.open_files()) {
    warnings_.push_back(fmt::format("{}: is not closed, so it counts 0 m3 in limits.volume", file));
  }
}

TargetView LimitTarget::view() const {
  if (!gauge_.wants_model()) return TargetView::genes;
  return shown_ == VolumeView::parts ? TargetView::parts : TargetView::full;
}

std::unique_ptr<TargetScratch> LimitTarget::make_scratch() const { return std::make_unique<LimitScratch>(); }

double LimitTarget::score(const Derivation& derivation, const Model& model, TargetScratch* scratch) const {
  LimitScratch& s = scratch_of(scratch);
  gauge_.measure(derivation, model, s.gauge, s.values);
  const bool growing = may_reject_ && !is_finished(derivation);
  double sum = 0;
  bool rejected = false;
  for (const Measure measure : measures_) {
    const double value = s.values[measure];
    sum -= limits_[measure].cost(value);
    if (growing ? may_still_be_accepted(measure, limits_[measure], value) : limits_[measure].accepts(value)) continue;
    rejected = true;
    Tally& tally = s.rejected[measure];
    ++tally.count;
    tally.lowest = std::min(tally.lowest, value);
    tally.highest = std::max(tally.highest, value);
  }
  return rejected ? -kInfinity : sum;
}

Explanation LimitTarget::explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const {
  LimitScratch& s = scratch_of(scratch);
  gauge_.measure(derivation, model, s.gauge, s.values);
  Explanation e;
  e.name = name_;
  for (const Measure measure : measures_) {
    const Limit& limit = limits_[measure];
    const double value = s.values[measure], cost = limit.cost(value);
    e.score -= cost;
    // Beside the value stands where the ramp ends, or without a ramp the largest that is allowed.
    const double of = limit.weight > 0 ? std::max(limit.from, limit.to) : limit.max.value_or(0);
    const MeasureFacts& facts = facts_of(measure);
    e.terms.push_back({std::string(facts.name), 0 - limit.weight, value, of, 0 - cost, std::string(facts.unit)});
    e.words += (e.words.empty() ? "" : ", ") + describe(measure, limit, value);
    const std::string rejection = describe_rejection(measure, limit, value);
    if (!rejection.empty()) e.rejected += (e.rejected.empty() ? "" : ", ") + rejection;
  }
  if (!e.rejected.empty()) e.score = -kInfinity;
  return e;
}

std::vector<Rejections> LimitTarget::rejections(const TargetScratch* scratch) const {
  const auto& s = static_cast<const LimitScratch&>(*scratch);
  std::vector<Rejections> all;
  for (const Measure measure : measures_) {
    const Limit& limit = limits_[measure];
    if (!limit.min && !limit.max) continue;
    const Tally& tally = s.rejected[measure];
    const MeasureFacts& facts = facts_of(measure);
    all.push_back({std::string(facts.name), describe_bounds(measure, limit), std::string(facts.unit), tally.count,
                   tally.lowest, tally.highest});
  }
  return all;
}

}  // namespace espalier
