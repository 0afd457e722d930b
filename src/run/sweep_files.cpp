// The numbers of a sweep as CSV and JSON.
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "run/csv.h"
#include "run/json_number.h"
#include "run/sweep.h"

namespace espalier {
namespace {

using nlohmann::ordered_json;

/// The columns of the varied settings, each followed by a comma.
std::string key_fields(const SweepRequest& request) {
  std::string text;
  for (const VariedSetting& one : request.varied) text += csv_field(one.key) + ",";
  return text;
}

std::string value_fields(const SweepRequest& request, std::size_t combination) {
  std::string text;
  for (std::size_t i = 0; i < request.varied.size(); ++i)
    text += csv_field(request.varied[i].values[request.combinations[combination][i]]) + ",";
  return text;
}

double step_of(const StepReport& report) { return static_cast<double>(report.step); }

void add_curve(const SweepRequest& request, const SweepResult& result, std::size_t i, std::string& text) {
  const std::vector<double> steps = sweep_steps(result, {i});
  const auto curve = [&](double (*value)(const StepReport&)) { return sweep_curve(result, i, steps, step_of, value); };
  const CompareCurve best = curve([](const StepReport& r) { return r.best; });
  const CompareCurve mean = curve([](const StepReport& r) { return r.mean; });
  const CompareCurve evaluations = curve([](const StepReport& r) { return static_cast<double>(r.evaluations); });
  const CompareCurve seconds = curve([](const StepReport& r) { return r.seconds; });
  const std::string fields = value_fields(request, i);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (!best.points[k]) continue;
    text += fmt::format("{},{}{:.0f},{},{},{},{},{},{},{}\n", i + 1, fields, steps[k], best.points[k]->count,
                        csv_number(evaluations.points[k]->mean), csv_number(seconds.points[k]->mean),
                        csv_number(best.points[k]->mean), csv_number(best.points[k]->deviation),
                        csv_number(mean.points[k]->mean), csv_number(mean.points[k]->deviation));
  }
}

ordered_json json_of(const SweepRequest& request, const SweepResult& result, std::size_t i) {
  const SweepCombination& combination = result.combinations[i];
  ordered_json values = ordered_json::object();
  for (std::size_t k = 0; k < request.varied.size(); ++k)
    values[request.varied[k].key] = request.varied[k].values[request.combinations[i][k]];
  ordered_json json = {{"combination", i + 1}, {"values", values}};
  if (!combination.scores) return json;
  const SampleSummary& s = *combination.scores;
  json["seeds"] = s.count;
  json["median"] = number_or_null(s.median), json["mean"] = number_or_null(s.mean);
  json["standard_deviation"] = number_or_null(s.deviation), json["interquartile_range"] = number_or_null(s.iqr());
  json["min"] = number_or_null(s.min), json["max"] = number_or_null(s.max);
  json["p_against_best"] = combination.chance;
  return json;
}

}  // namespace

std::string sweep_csv(const SweepRequest& request, const SweepResult& result) {
  std::string text = "combination,seed," + key_fields(request) +
                     "score,share,best,evaluations,steps,seconds,genes,derivation,ended_by\n";
  for (std::size_t i = 0; i < result.combinations.size(); ++i) {
    for (const std::optional<ContestOutcome>& search : result.combinations[i].searches) {
      if (!search) continue;
      text += fmt::format("{},{},{}", i + 1, search->seed, value_fields(request, i));
      if (!search->problem.empty()) {
        text += fmt::format(",,,,,,,,{}\n", csv_field(search->problem));
        continue;
      }
      const double score = search->score.value_or(NAN);
      text += fmt::format("{},{},{},{},{},{:.6f},{},{},{}\n", csv_number(score), csv_share(score, result.optimum),
                          search->best.score, search->evaluations, search->step_count, search->seconds, search->genes,
                          search->derivation, search->stopped_by);
    }
  }
  return text;
}

std::string sweep_effects_csv(const SweepRequest& request, const SweepResult& result) {
  std::string text = "setting,value,combinations,median,median_share,lower_quartile,upper_quartile,min,max,"
                     "came_to_nothing\n";
  for (std::size_t i = 0; i < request.varied.size(); ++i) {
    for (const SweepEffect& effect : result.effects[i]) {
      text += fmt::format("{},{},", csv_field(request.varied[i].key), csv_field(effect.value));
      if (!effect.medians) {
        text += "0,,,,,,,0\n";
        continue;
      }
      const SampleSummary& s = *effect.medians;
      text += fmt::format("{},{},{},{},{},{},{},{}\n", s.count, csv_number(s.median),
                          csv_share(s.median, result.optimum), csv_number(s.lower), csv_number(s.upper),
                          csv_number(s.min), csv_number(s.max), effect.nothing);
    }
  }
  return text;
}

std::string sweep_curves_csv(const SweepRequest& request, const SweepResult& result) {
  std::string text = "combination," + key_fields(request) +
                     "step,seeds,evaluations,seconds,best_mean,best_deviation,population_mean,population_deviation\n";
  for (std::size_t i = 0; i < result.combinations.size(); ++i) add_curve(request, result, i, text);
  return text;
}

std::string sweep_json(const SweepRequest& request, const SweepResult& result) {
  const Contest& contest = request.contest;
  ordered_json combinations = ordered_json::array(), effects = ordered_json::object();
  for (const std::size_t i : result.ranking) combinations.push_back(json_of(request, result, i));
  for (std::size_t i = 0; i < request.varied.size(); ++i)
    effects[request.varied[i].key] = number_or_null(effect_of(result.effects[i]).value_or(NAN));
  ordered_json document = head_json("espalier_sweep", contest, result);
  document["interrupted"] = result.interrupted;
  document["searches_failed"] = result.failed;
  document["warnings"] = result.warnings;
  document["effects"] = effects;
  document["ranking"] = combinations;
  return document.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace espalier
