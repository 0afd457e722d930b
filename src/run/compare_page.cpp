#include "run/compare_page.h"

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

namespace espalier {
namespace {

constexpr std::uint32_t kMostAcross = 800;

std::vector<std::string> names_in(const Contest& contest) {
  std::vector<std::string> names;
  for (const ContestVariant& variant : contest.variants) names.push_back(variant.name);
  return names;
}

std::string chance_html(const CompareMark& mark, std::size_t v) {
  return v == mark.ranking[0] ? "" : escape_html(chance_in_words(mark.chance[v]));
}

std::string words(const Contest& contest, const CompareResult& result) {
  const CompareMark& last = result.summary.marks.back();
  const std::string interruption = interruption_in_words(contest, result);
  return fmt::format("{}After {}, {} is ahead{}.",
                     interruption.empty() ? "" : fmt::format("<b>Interrupted: {}.</b> ", escape_html(interruption)),
                     in_words(result.summary.effort, last.at),
                     escape_html(contest.variants[last.ranking[0]].name),
                     escape_html(told_apart_in_words(contest, last)));
}

std::string headline(const Contest& contest, const CompareResult& result) {
  const CompareMark& last = result.summary.marks.back();
  const std::size_t best = last.ranking[0];
  return fmt::format("<span class=\"percent\">{}</span> <span class=\"score\">median of {}</span>",
                     score_html(last.scores[best].median, result.optimum), escape_html(contest.variants[best].name));
}

std::string search_line(const Contest& contest, const CompareResult& result) {
  std::string text = fmt::format("{}, {} each, taking turns on {}", counted(result.summary.counted.size(), "seed"),
                                 in_words(contest.budget),
                                 counted(static_cast<std::size_t>(result.threads), "thread"));
  if (contest.clock == StopwatchClock::computing) text += ", seconds of computing";
  if (result.summary.partial) text += "; stopped by hand before any seed was done";
  else if (result.interrupted)
    text += fmt::format("; stopped by hand, {} planned", counted(contest.seeds.size(), "seed"));
  return text;
}

std::string mark_rows(const Contest& contest, const CompareResult& result, const CompareMark& mark) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const SampleSummary& s : mark.scores) {
    if (std::isfinite(s.min)) low = std::min(low, s.min);
    if (std::isfinite(s.max)) high = std::max(high, s.max);
  }
  std::string html = fmt::format(
      "<tr class=\"mark\"><th colspan=\"8\" scope=\"rowgroup\"><span><b>after {}</b> {}{}</span></th></tr>\n",
      in_words(result.summary.effort, mark.at), escape_html(contest.variants[mark.ranking[0]].name),
      escape_html(told_apart_in_words(contest, mark)));
  for (const std::size_t v : mark.ranking) {
    const SampleSummary& s = mark.scores[v];
    const auto cell = [&](double value) { return "<td>" + score_html(value, result.optimum) + "</td>"; };
    html += fmt::format("<tr class=\"{}\"><th scope=\"row\">{}{}</th>", v == mark.ranking[0] ? "ahead" : "", swatch(v),
                        escape_html(contest.variants[v].name));
    html += cell(s.median);
    html += std::isfinite(s.mean) ? fmt::format("<td class=\"plain\">{} &plusmn; {}</td>",
                                                score_html(s.mean, result.optimum),
                                                score_html(s.deviation, result.optimum))
                                  : "<td>&ndash;</td>";
    for (const double value : {s.iqr(), s.min, s.max}) {
      html += "<td class=\"plain\">" + score_html(value, result.optimum) + "</td>";
    }
    html += fmt::format("<td class=\"plain\">{}</td>", chance_html(mark, v));
    html += spread_cell(s, low, high, kind_of(v)) + "</tr>\n";
  }
  return html;
}

std::string marks_html(const Contest& contest, const CompareResult& result) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\"><table class=\"numbers\">\n<thead><tr><th scope=\"col\">variant</th>"
      "<th scope=\"col\">median</th><th scope=\"col\">mean &plusmn; deviation</th>"
      "<th scope=\"col\">quartiles apart</th><th scope=\"col\">least</th><th scope=\"col\">most</th>"
      "<th scope=\"col\">p</th><th scope=\"col\">least, quartiles, median, most</th></tr></thead>\n<tbody>\n";
  for (const CompareMark& mark : result.summary.marks) html += mark_rows(contest, result, mark);
  const std::size_t seeds = result.summary.counted.size();
  return html + fmt::format(
      "</tbody></table></div>\n<p class=\"note\">{}p: how often chance alone would set a variant and the first of the "
      "ranking at least so far apart (exact rank test of Mann and Whitney, two-sided, by Holm's correction for all "
      "that are held against the first); with {} and {} it cannot be below {}. The first was chosen by these same "
      "scores: hold the two that matter against each other again, with other seeds.</p>\n",
      result.optimum > 0 ? fmt::format("In per cent of the most that any model could score, {}. ",
                                       readable_number(result.optimum)) : "",
      counted(seeds, "seed"), counted(contest.variants.size(), "variant"),
      chance_in_words(least_chance(seeds, contest.variants.size())));
}

std::string reach_cell(const CompareReach& reach, Effort effort) {
  if (reach.reached == 0) return "<td>&ndash;</td>";
  const std::string share =
      reach.reached < reach.of ? fmt::format(" <small>{}/{}</small>", reach.reached, reach.of) : "";
  if (!reach.median) return fmt::format("<td>&ndash;{}</td>", share);
  return fmt::format("<td>{}{}</td>", effort == Effort::seconds ? fmt::format("{:.3g} s", *reach.median)
                                                                : readable_number(std::round(*reach.median)), share);
}

std::string reach_html(const Contest& contest, const CompareResult& result) {
  const CompareSummary& summary = result.summary;
  std::string html = "<div class=\"scroll\" tabindex=\"0\"><table class=\"numbers\">\n<thead><tr>"
                     "<th scope=\"col\">until it passed the last median of</th>";
  for (std::size_t v = 0; v < contest.variants.size(); ++v) {
    html += fmt::format("<th scope=\"col\">{}<br>{}</th>", escape_html(contest.variants[v].name),
                        score_html(summary.marks.back().scores[v].median, result.optimum));
  }
  html += "</tr></thead>\n<tbody>\n";
  const auto& rows = summary.reach[static_cast<std::size_t>(summary.effort)];
  for (std::size_t who = 0; who < rows.size(); ++who) {
    html += fmt::format("<tr><th scope=\"row\">{}{}</th>", swatch(who), escape_html(contest.variants[who].name));
    for (const CompareReach& reach : rows[who]) html += reach_cell(reach, summary.effort);
    html += "</tr>\n";
  }
  return html + fmt::format("</tbody></table></div>\n<p class=\"note\">Median of the {} that each took; a fraction "
                            "says how many of its seeds got there.</p>\n", name_of(summary.effort));
}

std::string work_html(const Contest& contest, const CompareResult& result) {
  std::string html = "<div class=\"scroll\" tabindex=\"0\"><table class=\"numbers\">\n<thead><tr>"
                     "<th scope=\"col\">variant</th><th scope=\"col\">evaluations per second</th>"
                     "<th scope=\"col\">evaluations</th><th scope=\"col\">steps</th><th scope=\"col\">seconds</th>"
                     "</tr></thead>\n<tbody>\n";
  for (std::size_t v = 0; v < contest.variants.size(); ++v) {
    std::vector<double> evaluations, steps, seconds;
    for (const std::size_t s : result.summary.counted) {
      const std::optional<ContestOutcome>& outcome = result.outcomes[v][s];
      if (!outcome || !outcome->problem.empty()) continue;
      evaluations.push_back(static_cast<double>(outcome->evaluations));
      steps.push_back(static_cast<double>(outcome->step_count));
      seconds.push_back(outcome->seconds);
    }
    if (evaluations.empty()) continue;
    html += fmt::format("<tr><th scope=\"row\">{}{}</th><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td></tr>\n",
                        swatch(v), escape_html(contest.variants[v].name),
                        readable_number(std::round(result.summary.evaluations_per_second[v])),
                        readable_number(summarise(evaluations).median), readable_number(summarise(steps).median),
                        summarise(seconds).median);
  }
  return html + "</tbody></table></div>\n<p class=\"note\">Medians over the seeds.</p>\n";
}

std::string pictures_html(const Contest& contest, const CompareResult& result, const ComparePageParts& parts) {
  std::string html;
  for (std::size_t v = 0; v < contest.variants.size(); ++v) {
    if (!result.bests[v] || !parts.pictures[v]) continue;
    const ContestBest& best = *result.bests[v];
    const std::string name = escape_html(contest.variants[v].name);
    const Picture small = shrunk(*parts.pictures[v], kMostAcross);
    html += fmt::format(
        "<figure class=\"{}\">\n<img src=\"{}\" alt=\"The best of {}\">\n<figcaption><b>{}</b> "
        "<span class=\"figure-score\">{} &middot; {}</span><span>seed {}, {}</span>"
        "<span><a href=\"{}.best.glb\">model</a> &middot; <a href=\"{}.best.derivation.json\">derivation</a> &middot; "
        "<a href=\"{}.png\">picture</a></span></figcaption>\n</figure>\n",
        kind_of(v), png_url(encode_png(small.width, small.height, small.rgb, "Title", "espalier: best")), name, name,
        score_html(best.individual.score, result.optimum), readable_number(best.individual.score), best.seed,
        counted(best.individual.derivation.size(), "gene"), name, name, name);
  }
  return html;
}

/// Of the pictures on a wide screen: rows as full as can be.
std::size_t columns_of(std::size_t pictures) { return pictures <= 5 ? pictures : (pictures + 1) / 2; }

std::string commands(const Contest& contest, const CompareResult& result) {
  std::string text;
  for (std::size_t v = 0; v < contest.variants.size(); ++v) {
    if (!result.bests[v]) continue;
    const std::string& name = contest.variants[v].name;
    text += fmt::format("espalier reproduce {}.best.glb\n", name);
    text += fmt::format("espalier run {0}.toml --seed {1} --generations {2} --out ../{0}-again\n", name,
                        result.bests[v]->seed, result.bests[v]->steps);
  }
  return text;
}

std::string data_json(const Contest& contest, const CompareResult& result) {
  std::vector<std::string> axes;
  for (const CompareAxis& axis : result.summary.axes)
    axes.push_back(axis_json(std::string(name_of(axis.effort)), axis.at, axis.curves));
  return chart_json(result.optimum, names_in(contest), names_in(contest), axes);
}

}  // namespace

std::string compare_page(const Contest& contest, const CompareResult& result, const ComparePageParts& parts) {
  std::string settings;
  for (std::size_t v = 0; v < contest.variants.size(); ++v)
    settings += settings_box(contest.variants[v], parts.settings[v]);
  return fill_template(kCompareHtml,
                       {{"css", std::string(kReportCss) + std::string(kContestCss)},
                        {"js", std::string(kContestJs)},
                        {"version", kVersion},
                        {"grammar", escape_html(result.grammar)},
                        {"names", escape_html(listed_names(names_in(contest)))},
                        {"headline", headline(contest, result)},
                        {"words", words(contest, result)},
                        {"search", search_line(contest, result)},
                        {"warnings", warning_list(result.warnings)},
                        {"legend", legend(names_in(contest))},
                        {"marks", marks_html(contest, result)},
                        {"reach", reach_html(contest, result)},
                        {"work", work_html(contest, result)},
                        {"pictures", pictures_html(contest, result, parts)},
                        {"columns", fmt::format("{}", columns_of(contest.variants.size()))},
                        {"settings", settings},
                        {"commands", escape_html(commands(contest, result))},
                        {"command", escape_html(parts.command)},
                        {"provenance", contest_provenance(contest, result.machine, *parts.inputs)},
                        {"data", data_json(contest, result)}});
}

}  // namespace espalier
