// sweep.html: which combination did best, how much each setting matters, and curves of the best.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/counted.h"
#include "base/version.h"
#include "io/png.h"
#include "run/contest_html.h"
#include "run/page_assets.h"
#include "run/report_assets.h"
#include "run/report_text.h"
#include "run/sweep.h"

namespace espalier {
namespace {

constexpr std::size_t kMostCurves = 8;
constexpr std::uint32_t kMostAcross = 800;

/// "search.population" as "population": what differs is at the end.
std::string short_key(const std::string& key) { return key.substr(key.rfind('.') + 1); }

std::string short_name(const SweepRequest& request, std::size_t combination) {
  std::string name;
  for (std::size_t i = 0; i < request.varied.size(); ++i) {
    name += fmt::format("{}{} {}", i > 0 ? ", " : "", short_key(request.varied[i].key),
                        request.varied[i].values[request.combinations[combination][i]]);
  }
  return name;
}

/// "50, 0.5".
std::string values_of(const SweepRequest& request, std::size_t combination) {
  std::string text;
  for (std::size_t i = 0; i < request.varied.size(); ++i)
    text += (i > 0 ? ", " : "") + request.varied[i].values[request.combinations[combination][i]];
  return text;
}

std::vector<std::size_t> shown_of(const SweepResult& result) {
  std::vector<std::size_t> shown;
  for (const std::size_t i : result.ranking) {
    if (shown.size() < kMostCurves && result.combinations[i].scores) shown.push_back(i);
  }
  return shown;
}

std::string effect_rows(const SweepRequest& request, const SweepResult& result, std::size_t setting, double low,
                        double high) {
  const std::vector<SweepEffect>& effects = result.effects[setting];
  double best = -HUGE_VAL;
  for (const SweepEffect& effect : effects)
    if (effect.medians) best = std::max(best, effect.medians->median);
  const std::optional<double> apart = effect_of(effects);
  std::string html = fmt::format(
      "<tr class=\"mark\"><th colspan=\"5\" scope=\"rowgroup\"><span><b>{}</b>{}</span></th></tr>\n",
      escape_html(request.varied[setting].key),
      apart ? fmt::format(" values lie {} apart", score_html(*apart, result.optimum)) : "");
  for (const SweepEffect& effect : effects) {
    html += fmt::format("<tr class=\"{}\"><th scope=\"row\"><code>{}</code></th>",
                        effect.medians && std::isfinite(best) && effect.medians->median == best ? "ahead" : "",
                        escape_html(effect.value));
    if (!effect.medians) {
      html += "<td>&ndash;</td><td></td><td></td><td></td></tr>\n";
      continue;
    }
    html += fmt::format("<td>{}</td><td class=\"plain\">{}</td><td class=\"plain\">{}{}</td>{}</tr>\n",
                        score_html(effect.medians->median, result.optimum),
                        score_html(effect.medians->max, result.optimum), effect.medians->count,
                        effect.nothing > 0 ? fmt::format(" ({} came to nothing)", effect.nothing) : "",
                        spread_cell(*effect.medians, low, high, kind_of(setting)));
  }
  return html;
}

std::string effects_html(const SweepRequest& request, const SweepResult& result) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const auto& effects : result.effects) {
    for (const SweepEffect& effect : effects) {
      if (!effect.medians || !std::isfinite(effect.medians->max)) continue;
      high = std::max(high, effect.medians->max);
      if (std::isfinite(effect.medians->min)) low = std::min(low, effect.medians->min);
    }
  }
  std::string html = "<div class=\"scroll\" tabindex=\"0\"><table class=\"numbers\">\n<thead><tr>"
                     "<th scope=\"col\">value</th><th scope=\"col\">median</th><th scope=\"col\">most</th>"
                     "<th scope=\"col\">combinations</th>"
                     "<th scope=\"col\">least, quartiles, median, most</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < request.varied.size(); ++i) html += effect_rows(request, result, i, low, high);
  return html + "</tbody></table></div>\n<p class=\"note\">Each row is over all combinations that have the value: of "
                "their medians over the seeds. One that came to nothing counts as the worst.</p>\n";
}

std::string table_row(const SweepRequest& request, const SweepResult& result, std::size_t rank, double low, double high,
                      std::size_t curves) {
  const std::size_t i = result.ranking[rank];
  const SweepCombination& combination = result.combinations[i];
  std::string html = fmt::format("<tr class=\"{}\"><th scope=\"row\">{}{}</th>", rank == 0 ? "ahead" : "",
                                 rank < curves ? swatch(rank) : "", rank + 1);
  for (std::size_t k = 0; k < request.varied.size(); ++k)
    html += fmt::format("<td><code>{}</code></td>", escape_html(request.varied[k].values[request.combinations[i][k]]));
  if (!combination.scores) return html + "<td colspan=\"7\">not begun</td></tr>\n";
  const SampleSummary& s = *combination.scores;
  const std::size_t failed = failed_of(combination.searches);
  html += "<td>" + score_html(s.median, result.optimum) + "</td>";
  for (const double value : {s.iqr(), s.min, s.max})
    html += "<td class=\"plain\">" + score_html(value, result.optimum) + "</td>";
  html += fmt::format("<td class=\"plain\">{}</td><td class=\"plain\">{}{}</td>",
                      rank == 0 ? "" : escape_html(chance_in_words(combination.chance)), s.count,
                      failed > 0 ? fmt::format(" ({} failed)", failed) : "");
  return html + spread_cell(s, low, high, rank < curves ? kind_of(rank) : "s7") + "</tr>\n";
}

std::string table_html(const SweepRequest& request, const SweepResult& result, std::size_t curves) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const SweepCombination& combination : result.combinations) {
    if (!combination.scores) continue;
    if (std::isfinite(combination.scores->min)) low = std::min(low, combination.scores->min);
    if (std::isfinite(combination.scores->max)) high = std::max(high, combination.scores->max);
  }
  std::string html = "<div class=\"scroll\" tabindex=\"0\"><table class=\"numbers\">\n<thead><tr>"
                     "<th scope=\"col\">rank</th>";
  for (const VariedSetting& one : request.varied)
    html += fmt::format("<th scope=\"col\">{}</th>", escape_html(short_key(one.key)));
  html += "<th scope=\"col\">median</th><th scope=\"col\">quartiles apart</th><th scope=\"col\">least</th>"
          "<th scope=\"col\">most</th><th scope=\"col\">p</th><th scope=\"col\">seeds</th>"
          "<th scope=\"col\">least, quartiles, median, most</th></tr></thead>\n<tbody>\n";
  for (std::size_t rank = 0; rank < result.ranking.size(); ++rank)
    html += table_row(request, result, rank, low, high, curves);
  const std::size_t seeds = result.combinations[result.ranking[0]].scores->count;
  return html + fmt::format(
      "</tbody></table></div>\n<p class=\"note\">{}p: how often chance alone would set a combination and the first at "
      "least so far apart (exact rank test of Mann and Whitney, two-sided, not corrected for how many there are); with "
      "{} it cannot be below {}. Of many combinations some are ahead by chance: try the first ones again with other "
      "seeds.</p>\n",
      result.optimum > 0 ? fmt::format("In per cent of the most that any model could score, {}. ",
                                       readable_number(result.optimum)) : "",
      counted(seeds, "seed"), chance_in_words(least_rank_test(seeds, seeds)));
}

std::string picture_html(const SweepResult& result, const SweepPageParts& parts) {
  const Picture small = shrunk(*parts.picture, kMostAcross);
  return fmt::format(
      "<figure class=\"s0\">\n<img src=\"{}\" alt=\"The best\">\n<figcaption><b>The best of the first combination</b> "
      "<span class=\"figure-score\">{} &middot; {}</span><span>seed {}, {}</span>"
      "<span><a href=\"best.glb\">model</a> &middot; <a href=\"best.derivation.json\">derivation</a> &middot; "
      "<a href=\"best.png\">picture</a> &middot; <a href=\"best.toml\">scene</a></span></figcaption>\n</figure>\n",
      png_url(encode_png(small.width, small.height, small.rgb, "Title", "espalier: best")),
      score_html(parts.best->individual.score, result.optimum), readable_number(parts.best->individual.score),
      parts.best->seed, counted(parts.best->individual.derivation.size(), "gene"));
}

std::string data_json(const SweepRequest& request, const SweepResult& result) {
  const std::vector<std::size_t> shown = shown_of(result);
  std::vector<std::string> names, labels;
  for (const std::size_t i : shown) names.push_back(short_name(request, i)), labels.push_back(values_of(request, i));
  const bool by_time = request.contest.budget.seconds.has_value();
  double last = 0;
  const auto spent = by_time ? [](const StepReport& r) { return r.seconds; }
                             : [](const StepReport& r) { return static_cast<double>(r.evaluations); };
  double first = HUGE_VAL;
  for (const std::size_t i : shown) {
    for (const std::optional<ContestOutcome>& search : result.combinations[i].searches) {
      if (!search || search->steps.empty()) continue;
      first = std::min(first, spent(search->steps.front())), last = std::max(last, spent(search->steps.back()));
    }
  }
  if (by_time) last = std::min(last, *request.contest.budget.seconds);
  if (request.contest.budget.evaluations)
    last = std::min(last, static_cast<double>(*request.contest.budget.evaluations));
  const std::vector<double> at = axis_points(by_time ? Effort::seconds : Effort::evaluations, first, last, {});
  const std::vector<double> steps = sweep_steps(result, shown);
  std::vector<CompareCurve> best, mean;
  for (const std::size_t i : shown) {
    best.push_back(sweep_curve(result, i, at, spent, [](const StepReport& r) { return r.best; }));
    mean.push_back(sweep_curve(result, i, steps, [](const StepReport& r) { return static_cast<double>(r.step); },
                               [](const StepReport& r) { return r.mean; }));
  }
  return chart_json(result.optimum, names, labels, {axis_json(by_time ? "seconds" : "evaluations", at, best),
                                            axis_json("steps", steps, mean)});
}

std::string words(const SweepRequest& request, const SweepResult& result) {
  const auto most = std::max_element(result.effects.begin(), result.effects.end(),
                                     [](const auto& a, const auto& b) { return effect_of(a) < effect_of(b); });
  std::string text = "Best: " + escape_html(short_name(request, result.ranking[0])) + ".";
  const bool all = std::all_of(result.effects.begin(), result.effects.end(),
                               [](const auto& effects) { return effect_of(effects).has_value(); });
  if (request.varied.size() > 1 && all) {
    text += fmt::format(" What matters most is {}.",
                        escape_html(request.varied[static_cast<std::size_t>(most - result.effects.begin())].key));
  }
  return text;
}

std::string search_line(const SweepRequest& request, const SweepResult& result) {
  const Contest& contest = request.contest;
  std::string text = fmt::format("{} x {}, {} each, taking turns on {}",
                                 counted(contest.variants.size(), "combination"), counted(contest.seeds.size(), "seed"),
                                 in_words(contest.budget), counted(static_cast<std::size_t>(result.threads), "thread"));
  return text + (result.interrupted ? "; stopped by hand" : "");
}

}  // namespace

std::string sweep_page(const SweepRequest& request, const SweepResult& result, const SweepPageParts& parts) {
  const std::vector<std::size_t> shown = shown_of(result);
  std::vector<std::string> names;
  for (const std::size_t i : shown) names.push_back(short_name(request, i));
  const SampleSummary& best = *result.combinations[result.ranking[0]].scores;
  return fill_template(
      kSweepHtml,
      {{"css", std::string(kReportCss) + std::string(kContestCss)},
       {"js", std::string(kContestJs)},
       {"version", kVersion},
       {"grammar", escape_html(result.grammar)},
       {"headline", fmt::format("<span class=\"percent\">{}</span> <span class=\"score\">median of the best</span>",
                                score_html(best.median, result.optimum))},
       {"words", words(request, result)},
       {"search", search_line(request, result)},
       {"warnings", warning_list(result.warnings)},
       {"effects", effects_html(request, result)},
       {"table", table_html(request, result, shown.size())},
       {"picture", picture_html(result, parts)},
       {"legend", legend(names)},
       {"first-axis", request.contest.budget.seconds ? "seconds of its own" : "evaluations"},
       {"curves", shown.size() < result.combinations.size() ? fmt::format("The first {}", shown.size()) : "All"},
       {"settings", escape_html(parts.settings)},
       {"command", escape_html(request.command)},
       {"provenance", contest_provenance(request.contest, result.machine, *parts.inputs)},
       {"data", data_json(request, result)}});
}

}  // namespace espalier
