// The numbers of a comparison as CSV and JSON.
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "run/csv.h"
#include "run/json_number.h"
#include "run/compare.h"

namespace espalier {
namespace {

using nlohmann::ordered_json;

std::string number_of(Effort effort, double spent) {
  return effort == Effort::seconds ? csv_number(spent) : fmt::format("{:.0f}", spent);
}

ordered_json json_of(const SampleSummary& s) {
  return {{"median", number_or_null(s.median)}, {"mean", number_or_null(s.mean)},
          {"standard_deviation", number_or_null(s.deviation)}, {"lower_quartile", number_or_null(s.lower)},
          {"upper_quartile", number_or_null(s.upper)}, {"min", number_or_null(s.min)}, {"max", number_or_null(s.max)}};
}

ordered_json json_of(const Contest& contest, const CompareMark& mark, Effort effort) {
  ordered_json variants = ordered_json::object(), ranking = ordered_json::array();
  for (const std::size_t v : mark.ranking) ranking.push_back(contest.variants[v].name);
  for (std::size_t v = 0; v < mark.scores.size(); ++v) {
    variants[contest.variants[v].name] = json_of(mark.scores[v]);
    variants[contest.variants[v].name]["p_against_best"] = mark.chance[v];
  }
  return {{std::string(name_of(effort)), mark.at}, {"ranking", ranking}, {"variants", variants}};
}

ordered_json json_of(const Contest& contest, const CompareResult& result, std::size_t v) {
  const ContestVariant& variant = contest.variants[v];
  ordered_json best;
  if (result.bests[v]) {
    best = {{"seed", result.bests[v]->seed},
            {"steps", result.bests[v]->steps},
            {"score", result.bests[v]->individual.score},
            {"genes", result.bests[v]->individual.derivation.size()}};
  }
  return {{"name", variant.name},
          {"engine", name_of(variant.scene.search.engine)},
          {"settings", variant.settings},
          {"evaluations_per_second", result.summary.evaluations_per_second[v]},
          {"best", best}};
}

}  // namespace

std::string compare_csv(const Contest& contest, const CompareResult& result) {
  std::string text = "engine,seed,axis,at,best,share\n";
  for (std::size_t v = 0; v < contest.variants.size(); ++v) {
    for (const Effort effort : {Effort::evaluations, Effort::seconds}) {
      const CompareAxis& axis = result.summary.axis(effort);
      for (std::size_t s = 0; s < contest.seeds.size(); ++s) {
        const std::vector<std::optional<double>>& points = axis.curves[v].searches[s];
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (!points[i]) continue;
          text += fmt::format("{},{},{},{},{},{}\n", contest.variants[v].name, contest.seeds[s], name_of(effort),
                              number_of(effort, axis.at[i]), *points[i], csv_share(*points[i], result.optimum));
        }
      }
    }
  }
  return text;
}

std::string compare_summary_csv(const Contest& contest, const CompareResult& result) {
  const CompareSummary& summary = result.summary;
  std::string text =
      "engine,axis,at,rank,median,median_share,mean,standard_deviation,interquartile_range,min,max,seeds,"
      "p_against_best,evaluations_per_second\n";
  for (const CompareMark& mark : summary.marks) {
    for (std::size_t rank = 0; rank < mark.ranking.size(); ++rank) {
      const std::size_t v = mark.ranking[rank];
      const SampleSummary& s = mark.scores[v];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", contest.variants[v].name,
                          name_of(summary.effort), number_of(summary.effort, mark.at), rank + 1, csv_number(s.median),
                          csv_share(s.median, result.optimum), csv_number(s.mean), csv_number(s.deviation),
                          csv_number(s.iqr()), csv_number(s.min), csv_number(s.max), s.count,
                          csv_number(mark.chance[v]), csv_number(summary.evaluations_per_second[v]));
    }
  }
  return text;
}

std::string compare_reach_csv(const Contest& contest, const CompareResult& result) {
  const CompareSummary& summary = result.summary;
  std::string text = "engine,median_of,score,axis,reached,seeds,median\n";
  for (const Effort effort : {Effort::seconds, Effort::evaluations}) {
    const auto& rows = summary.reach[static_cast<std::size_t>(effort)];
    for (std::size_t who = 0; who < rows.size(); ++who) {
      for (std::size_t whose = 0; whose < rows.size(); ++whose) {
        const CompareReach& reach = rows[who][whose];
        text += fmt::format("{},{},{},{},{},{},{}\n", contest.variants[who].name, contest.variants[whose].name,
                            csv_number(summary.marks.back().scores[whose].median), name_of(effort), reach.reached,
                            reach.of, csv_number(reach.median));
      }
    }
  }
  return text;
}

std::string compare_searches_csv(const Contest& contest, const CompareResult& result) {
  std::string text = "engine,seed,score,share,best,evaluations,steps,seconds,genes,derivation,ended_by\n";
  for (std::size_t v = 0; v < contest.variants.size(); ++v) {
    for (const std::optional<ContestOutcome>& outcome : result.outcomes[v]) {
      if (!outcome) continue;
      const std::string who = fmt::format("{},{}", contest.variants[v].name, outcome->seed);
      if (!outcome->problem.empty()) {
        text += fmt::format("{},,,,,,,,,{}\n", who, csv_field(outcome->problem));
        continue;
      }
      const double score = outcome->score.value_or(NAN);
      text += fmt::format("{},{},{},{},{},{},{:.6f},{},{},{}\n", who, csv_number(score),
                          csv_share(score, result.optimum), outcome->best.score, outcome->evaluations,
                          outcome->step_count, outcome->seconds, outcome->genes, outcome->derivation,
                          outcome->stopped_by);
    }
  }
  return text;
}

std::string compare_json(const Contest& contest, const CompareResult& result) {
  const CompareSummary& summary = result.summary;
  ordered_json variants = ordered_json::array(), marks = ordered_json::array(), counted = ordered_json::array();
  for (std::size_t v = 0; v < contest.variants.size(); ++v) variants.push_back(json_of(contest, result, v));
  for (const CompareMark& mark : summary.marks) marks.push_back(json_of(contest, mark, summary.effort));
  for (const std::size_t s : summary.counted) counted.push_back(contest.seeds[s]);
  ordered_json document = head_json("espalier_compare", contest, result);
  document["seeds_counted"] = counted;
  document["interrupted"] = result.interrupted;
  document["cut_short"] = summary.partial;
  document["searches_failed"] = result.failed;
  document["warnings"] = result.warnings;
  document["variants"] = variants;
  document["marks"] = marks;
  return document.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace espalier
