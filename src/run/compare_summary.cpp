#include "run/compare_summary.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"

namespace espalier {
namespace {

constexpr int kPoints = 100;  // of each spacing

const ContestOutcome* outcome_of(const CompareOutcomes& outcomes, std::size_t variant, std::size_t seed) {
  const std::optional<ContestOutcome>& outcome = outcomes[variant][seed];
  return outcome && outcome->problem.empty() && !outcome->rises.empty() ? &*outcome : nullptr;
}

/// A search that failed counts: it came to nothing. One that was cut short, or not begun, does not.
bool counts(const std::optional<ContestOutcome>& outcome) {
  return outcome && (outcome->complete() || !outcome->problem.empty());
}

void find_counted(const CompareOutcomes& outcomes, CompareSummary& summary) {
  for (std::size_t seed = 0; seed < outcomes[0].size(); ++seed) {
    if (std::all_of(outcomes.begin(), outcomes.end(), [&](const auto& of) { return counts(of[seed]); }))
      summary.counted.push_back(seed);
  }
  summary.partial = summary.counted.empty();
  if (summary.partial) summary.counted.push_back(0);  // was begun first, and cut short
}

CompareAxis make_axis(const CompareOutcomes& outcomes, const CompareSummary& summary, Effort effort,
                      const SceneBudget& budget, const std::vector<double>& marks) {
  CompareAxis axis;
  axis.effort = effort;
  double first = kNotAcceptable, last = 0;
  for (std::size_t v = 0; v < outcomes.size(); ++v) {
    for (std::size_t s = 0; s < outcomes[v].size(); ++s) {
      const ContestOutcome* const outcome = outcome_of(outcomes, v, s);
      if (!outcome) continue;
      const double begin = outcome->rises.first(effort);
      first = std::isinf(first) ? begin : std::min(first, begin);
      last = std::max(last, outcome->rises.last(effort));
    }
  }
  if (effort == Effort::seconds && budget.seconds) last = std::min(last, *budget.seconds);
  if (effort == Effort::evaluations && budget.evaluations)
    last = std::min(last, static_cast<double>(*budget.evaluations));
  axis.at = axis_points(effort, first, last, effort == summary.effort ? marks : std::vector<double>());
  for (std::size_t v = 0; v < outcomes.size(); ++v) {
    CompareCurve curve;
    for (std::size_t s = 0; s < outcomes[v].size(); ++s) {
      const ContestOutcome* const outcome = outcome_of(outcomes, v, s);
      std::vector<std::optional<double>>& points = curve.searches.emplace_back(axis.at.size());
      for (std::size_t i = 0; outcome && i < axis.at.size(); ++i) points[i] = outcome->rises.at(effort, axis.at[i]);
    }
    for (std::size_t i = 0; i < axis.at.size(); ++i) {
      std::vector<double> values;
      for (const std::size_t s : summary.counted)
        if (curve.searches[s][i]) values.push_back(*curve.searches[s][i]);
      curve.points.emplace_back();
      if (values.size() == summary.counted.size()) curve.points.back() = summarise(std::move(values));
    }
    axis.curves.push_back(std::move(curve));
  }
  return axis;
}

/// Of what was cut short: the marks that all came to, and where the first of them stood in the end.
std::vector<double> marks_reached(const CompareOutcomes& outcomes, const CompareSummary& summary,
                                  const std::vector<double>& marks) {
  double least = marks.back();
  for (std::size_t v = 0; v < outcomes.size(); ++v) {
    const ContestOutcome* const outcome = outcome_of(outcomes, v, summary.counted[0]);
    if (outcome) least = std::min(least, outcome->rises.last(summary.effort));
  }
  std::vector<double> reached;
  for (const double mark : marks)
    if (mark < least && in_words(summary.effort, mark) != in_words(summary.effort, least)) reached.push_back(mark);
  reached.push_back(least);
  return reached;
}

/// `whole`: at the end of the budget, which outcomes know.
double score_at(const ContestOutcome* outcome, Effort effort, double mark, bool whole) {
  if (!outcome) return kNotAcceptable;
  return (whole ? outcome->score : outcome->rises.at(effort, mark)).value_or(kNotAcceptable);
}

std::vector<std::vector<double>> scores_at(const CompareOutcomes& outcomes, const CompareSummary& summary, double mark,
                                           bool whole) {
  std::vector<std::vector<double>> scores(outcomes.size());
  for (std::size_t v = 0; v < outcomes.size(); ++v) {
    for (const std::size_t s : summary.counted)
      scores[v].push_back(score_at(outcome_of(outcomes, v, s), summary.effort, mark, whole));
  }
  return scores;
}

CompareMark make_mark(const std::vector<std::vector<double>>& scores, double at) {
  CompareMark mark;
  mark.at = at;
  for (const std::vector<double>& of : scores) mark.scores.push_back(summarise(of));
  mark.ranking.resize(scores.size());
  std::iota(mark.ranking.begin(), mark.ranking.end(), std::size_t{0});
  std::stable_sort(mark.ranking.begin(), mark.ranking.end(), [&](std::size_t a, std::size_t b) {
    const SampleSummary &one = mark.scores[a], &two = mark.scores[b];
    return one.median != two.median ? one.median > two.median : one.mean > two.mean;
  });
  const std::size_t best = mark.ranking.front();
  std::vector<double> others;
  for (std::size_t v = 0; v < scores.size(); ++v)
    if (v != best) others.push_back(rank_test(scores[best], scores[v]));
  mark.chance = holm(others);
  mark.chance.insert(mark.chance.begin() + static_cast<std::ptrdiff_t>(best), 1.0);
  return mark;
}

/// Within what the last mark allows: a step that crosses the end of the budget counts no more here than for scores.
CompareReach reach_of(const CompareOutcomes& outcomes, const CompareSummary& summary, std::size_t who, Effort effort,
                      double score) {
  CompareReach reach;
  const double most = summary.marks.back().at;
  std::vector<double> needed;  // negative, so that what never came is last
  for (const std::size_t s : summary.counted) {
    const ContestOutcome* const outcome = outcome_of(outcomes, who, s);
    const std::optional<double> spent =
        outcome ? outcome->rises.reaching(effort, score, summary.effort, most) : std::nullopt;
    needed.push_back(spent ? -*spent : kNotAcceptable);
    reach.reached += spent.has_value();
  }
  reach.of = needed.size();
  std::sort(needed.begin(), needed.end());
  const double median = quantile(needed, 0.5);
  if (std::isfinite(median)) reach.median = -median;
  return reach;
}

void add_reach(const CompareOutcomes& outcomes, CompareSummary& summary) {
  const std::vector<SampleSummary>& ends = summary.marks.back().scores;
  for (const Effort effort : {Effort::seconds, Effort::evaluations}) {
    auto& rows = summary.reach[static_cast<std::size_t>(effort)];
    rows.resize(outcomes.size());
    for (std::size_t who = 0; who < outcomes.size(); ++who) {
      for (const SampleSummary& end : ends) {
        rows[who].push_back(std::isfinite(end.median) ? reach_of(outcomes, summary, who, effort, end.median)
                                                      : CompareReach{0, summary.counted.size(), {}});
      }
    }
  }
}

double speed_of(const CompareOutcomes& outcomes, const CompareSummary& summary, std::size_t variant) {
  double evaluations = 0, seconds = 0;
  for (const std::size_t s : summary.counted) {
    const ContestOutcome* const outcome = outcome_of(outcomes, variant, s);
    if (outcome) evaluations += static_cast<double>(outcome->evaluations), seconds += outcome->seconds;
  }
  return seconds > 0 ? evaluations / seconds : 0;
}

double whole_budget(const SceneBudget& budget) {
  return budget.seconds ? *budget.seconds : static_cast<double>(budget.evaluations.value_or(0));
}

}  // namespace

CompareSummary summarise_contest(const CompareOutcomes& outcomes, const SceneBudget& budget,
                                 const std::vector<double>& marks) {
  CHECK(!outcomes.empty() && !outcomes[0].empty() && !marks.empty());
  CompareSummary summary;
  summary.effort = effort_of(budget);
  find_counted(outcomes, summary);
  for (const Effort effort : {Effort::seconds, Effort::evaluations})
    summary.axes[static_cast<std::size_t>(effort)] = make_axis(outcomes, summary, effort, budget, marks);
  for (const double mark : summary.partial ? marks_reached(outcomes, summary, marks) : marks) {
    const bool whole = !summary.partial && mark == marks.back();
    summary.marks.push_back(make_mark(scores_at(outcomes, summary, mark, whole), mark));
  }
  add_reach(outcomes, summary);
  for (std::size_t v = 0; v < outcomes.size(); ++v)
    summary.evaluations_per_second.push_back(speed_of(outcomes, summary, v));
  return summary;
}

double least_chance(std::size_t seeds, std::size_t variants) {
  return holm(std::vector<double>(std::max<std::size_t>(variants, 2) - 1, least_rank_test(seeds, seeds))).front();
}

std::vector<double> default_marks(const SceneBudget& budget) {
  constexpr double kSeconds[] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 5, 30, 120, 600, 1800, 7200, 43'200, 172'800};
  const double whole = whole_budget(budget);
  std::vector<double> marks;
  if (budget.seconds) {
    for (const double mark : kSeconds) marks.push_back(mark);
  } else {
    for (double mark = 10; mark < 1e16; mark *= 10) marks.push_back(mark), marks.push_back(3 * mark);
  }
  std::erase_if(marks, [&](double mark) { return mark > 0.7 * whole; });
  constexpr std::size_t kMost = 3;  // beside the whole
  if (marks.size() > kMost) marks.erase(marks.begin(), marks.end() - kMost);
  marks.push_back(whole);
  return marks;
}

std::vector<double> parse_marks(std::string_view text, const SceneBudget& budget) {
  constexpr std::size_t kMost = 20;
  std::vector<double> marks;
  const double whole = whole_budget(budget);
  for (const std::string& member : split_list(text)) {
    double mark = 0;
    const auto [end, error] = std::from_chars(member.data(), member.data() + member.size(), mark);
    if (member.empty() || error != std::errc() || end != member.data() + member.size() || !(mark > 0) || mark > whole) {
      throw Error(fmt::format("--marks must be numbers above 0 and at most the budget, {}, got \"{}\"",
                              in_words(budget), member));
    }
    marks.push_back(mark);
  }
  marks.push_back(whole);
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  if (marks.size() > kMost) throw Error(fmt::format("--marks must be at most {}, got {}", kMost - 1, marks.size() - 1));
  return marks;
}

std::vector<double> axis_points(Effort effort, double first, double last, const std::vector<double>& marks) {
  if (!(last > 0)) return {};
  first = std::clamp(first, last * 1e-9, last);
  std::vector<double> points = {first, last};
  for (int i = 1; i < kPoints; ++i) {
    const double share = static_cast<double>(i) / kPoints;
    points.push_back(first * std::pow(last / first, share));
    points.push_back(first + (last - first) * share);
  }
  for (double& point : points) {
    if (effort == Effort::evaluations) point = std::round(point);
  }
  for (const double mark : marks)
    if (mark >= first && mark <= last) points.push_back(mark);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace espalier
