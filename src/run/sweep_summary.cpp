// What the searches of a sweep come to.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "run/sweep.h"

namespace espalier {
namespace {

constexpr double kFewSteps = 400;

void find_counted(const SweepRequest& request, SweepResult& result) {
  for (std::size_t seed = 0; seed < request.contest.seeds.size(); ++seed) {
    const bool all = std::all_of(result.combinations.begin(), result.combinations.end(), [&](const auto& combination) {
      const std::optional<ContestOutcome>& search = combination.searches[seed];
      return search && (search->complete() || !search->problem.empty());
    });
    if (all) result.counted.push_back(seed);
  }
}

/// Failed searches came to nothing; those cut short count where nothing better is there.
std::vector<double> scores_of(const SweepResult& result, const SweepCombination& combination) {
  std::vector<double> scores;
  for (const std::size_t seed : result.counted)
    scores.push_back(combination.searches[seed]->score.value_or(kNotAcceptable));
  if (!result.counted.empty()) return scores;
  for (const std::optional<ContestOutcome>& search : combination.searches)
    if (search) scores.push_back(search->score.value_or(kNotAcceptable));
  return scores;
}

void rank(SweepResult& result) {
  std::vector<std::vector<double>> scores;
  for (SweepCombination& combination : result.combinations) {
    scores.push_back(scores_of(result, combination));
    if (!scores.back().empty()) combination.scores = summarise(scores.back());
  }
  result.ranking.resize(result.combinations.size());
  std::iota(result.ranking.begin(), result.ranking.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const std::optional<SampleSummary>& s = result.combinations[i].scores;
    const bool finite = s && std::isfinite(s->median);
    return std::pair(finite ? s->median : kNotAcceptable, finite ? s->mean : kNotAcceptable);
  };
  std::stable_sort(result.ranking.begin(), result.ranking.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) > key(b); });
  const std::vector<double>& best = scores[result.ranking[0]];
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (i != result.ranking[0] && !scores[i].empty() && !best.empty())
      result.combinations[i].chance = rank_test(best, scores[i]);
  }
}

void find_effects(const SweepRequest& request, SweepResult& result) {
  for (std::size_t setting = 0; setting < request.varied.size(); ++setting) {
    std::vector<SweepEffect>& effects = result.effects.emplace_back();
    for (std::size_t value = 0; value < request.varied[setting].values.size(); ++value) {
      std::vector<double> medians;
      for (std::size_t i = 0; i < result.combinations.size(); ++i) {
        const std::optional<SampleSummary>& scores = result.combinations[i].scores;
        if (request.combinations[i][setting] == value && scores) medians.push_back(scores->median);
      }
      effects.push_back({request.varied[setting].values[value], std::nullopt});
      effects.back().nothing = static_cast<std::size_t>(std::count(medians.begin(), medians.end(), kNotAcceptable));
      if (!medians.empty()) effects.back().medians = summarise(std::move(medians));
    }
  }
}

}  // namespace

void summarise_sweep(const SweepRequest& request, SweepResult& result) {
  find_counted(request, result);
  rank(result);
  find_effects(request, result);
}

std::optional<double> effect_of(const std::vector<SweepEffect>& values) {
  std::size_t searched = 0;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const SweepEffect& effect : values) {
    if (!effect.medians) continue;
    if (!std::isfinite(effect.medians->median)) return std::nullopt;
    ++searched;
    low = std::min(low, effect.medians->median), high = std::max(high, effect.medians->median);
  }
  if (searched < 2) return std::nullopt;
  return high - low;
}

CompareCurve sweep_curve(const SweepResult& result, std::size_t combination, const std::vector<double>& at,
                         double (*spent)(const StepReport&), double (*value)(const StepReport&)) {
  CompareCurve curve;
  for (const std::optional<ContestOutcome>& search : result.combinations[combination].searches) {
    if (!search) continue;
    std::vector<std::optional<double>>& points = curve.searches.emplace_back(at.size());
    const std::vector<StepReport>& steps = search->steps;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto after = std::upper_bound(steps.begin(), steps.end(), at[i], [&](double x, const StepReport& step) {
        return x < spent(step);
      });
      if (after != steps.begin() && at[i] <= spent(steps.back())) points[i] = value(*(after - 1));
    }
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::vector<double> values;
    for (const auto& search : curve.searches)
      if (search[i]) values.push_back(*search[i]);
    curve.points.emplace_back();
    if (!values.empty() && values.size() == curve.searches.size()) curve.points.back() = summarise(std::move(values));
  }
  return curve;
}

std::vector<double> sweep_steps(const SweepResult& result, const std::vector<std::size_t>& combinations) {
  double last = 0;
  for (const std::size_t i : combinations) {
    for (const std::optional<ContestOutcome>& search : result.combinations[i].searches)
      if (search) last = std::max(last, static_cast<double>(search->step_count));
  }
  if (last > kFewSteps) return axis_points(Effort::evaluations, 1, last, {});
  std::vector<double> steps;
  for (double step = 1; step <= last; ++step) steps.push_back(step);
  return steps;
}

}  // namespace espalier
