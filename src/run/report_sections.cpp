// The sections of a report that are plain HTML.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.h"
#include "run/model_files.h"
#include "run/report.h"
#include "run/report_text.h"

namespace espalier {
namespace {

std::string legend(const std::vector<LegendRow>& rows) {
  if (rows.empty()) return "";
  std::string html = "\n<ul class=\"legend\">\n";
  for (const LegendRow& row : rows) {
    html += "<li>";
    for (const Colour& colour : row.swatches) html += fmt::format("<i style=\"background:{}\"></i>", hex_of(colour));
    html += escape_html(row.text) + "</li>\n";
  }
  return html + "</ul>\n";
}

/// `place`: its class, which the style sheet lays out by; may be empty.
std::string figure(const ReportPicture& picture, const char* place) {
  return fmt::format("<figure class=\"{}\">\n<img src=\"{}\" alt=\"{}\">\n<figcaption><b>{}</b> {}{}</figcaption>\n"
                     "</figure>\n", place, png_url(picture.png), escape_html(picture.title),
                     escape_html(picture.title), escape_html(picture.caption), legend(picture.legend));
}

std::string percent(double share) { return fmt::format("{:.1f}&thinsp;%", 100 * share); }

/// A bar from the middle: to the right what adds, to the left what takes away.
std::string bar(double value, double largest) {
  const double share = largest > 0 ? std::fabs(value) / largest : 0;
  if (value == 0) return "";
  return fmt::format("<span class=\"bar\" aria-hidden=\"true\"><i class=\"{}\" style=\"width:{:.2f}%\"></i></span>",
                     value < 0 ? "takes" : "adds", 50 * std::min(share, 1.0));
}

std::string term_row(const Term& term, double target_weight, double largest) {
  const double value = term.value * target_weight + 0.0;
  std::string count = readable_number(term.count) + " " + escape_html(term.unit);
  if (term.of > 0) {
    count += fmt::format(" <small>{} of {}</small>", percent(term.count / term.of), readable_number(term.of));
  }
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td data-label=\"counted\">{}</td>"
      "<td data-label=\"weight\">{}</td><td data-label=\"adds\" class=\"{}\">{}{}</td><td>{}</td></tr>\n",
      escape_html(term.name), count, readable_number(term.weight * target_weight), value < 0 ? "minus" : "",
      value > 0 ? "+" : "", readable_number(value), bar(value, largest));
}

std::string hash_row(const std::string& name, const std::string& value) {
  return fmt::format("<dt>{}</dt><dd><code>{}</code></dd>\n", escape_html(name), escape_html(value));
}

std::string links(std::size_t index) {
  const std::string stem = index == 0 ? "best" : fmt::format("alternatives/{:02}", index);
  std::string html;
  for (const char* ending : {".glb", ".derivation.json", ".png"}) {
    html += fmt::format("<a href=\"{0}{1}\">{1}</a> ", stem, ending);
  }
  return html;
}

std::string alternative_item(const ReportInput& input, std::size_t i) {
  const Individual& one = input.result.alternatives[i];
  const double optimum = input.result.explanation.optimum;
  std::string score = readable_number(one.score);
  if (optimum > 0) score += fmt::format(" ({})", percent(one.score / optimum));
  const std::string genes = fmt::format("{} gene{}", one.derivation.size(), one.derivation.size() == 1 ? "" : "s");
  return fmt::format(
      "<li><button type=\"button\" class=\"thumbnail\" data-score=\"{1}\" data-genes=\"{2}: {3}\" data-name=\"{0}\" "
      "data-files=\"alternatives/{0:02}\" data-hash=\"{6}\"><img src=\"{4}\" alt=\"Alternative {0}\">"
      "<span><b>{0}</b> {1}<br>{2}</span></button><noscript>{5}</noscript></li>\n",
      i + 1, score, genes, escape_html(genes_in_words(input.setup.graph(), one.derivation)),
      png_url(input.alternatives[i]), links(i + 1), hash_text(one.derivation));
}

}  // namespace

std::string genes_in_words(const GeneratorGraph& graph, const Derivation& derivation) {
  std::vector<std::pair<std::size_t, std::string>> counts(graph.rules.size());
  for (const GeneRecord& gene : derivation.genes) {
    auto& [count, name] = counts[graph.edges[gene.edge].child];
    ++count, name = rule_of(graph, gene).name;
  }
  std::stable_sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string words;
  for (const auto& [count, name] : counts) {
    if (count > 0) words += fmt::format("{}{} \xc3\x97 {}", words.empty() ? "" : ", ", name, count);
  }
  return words;
}

// The best and the volumes, then a row per silhouette: the drawing, what its camera sees, and both in one.
std::string pictures_html(const ReportInput& input) {
  const std::size_t silhouettes = std::min(input.setup.silhouettes.size(), input.targets.size());
  const std::size_t volumes = input.targets.size() - silhouettes;
  std::string html = figure(input.best, silhouettes > 1 && volumes == 0 ? "alone" : "");
  for (std::size_t i = 2 * silhouettes; i < input.outcomes.size(); ++i) html += figure(input.outcomes[i], "broad");
  for (std::size_t i = silhouettes; i < input.targets.size(); ++i) html += figure(input.targets[i], "");
  for (std::size_t i = 0; i < silhouettes; ++i) {
    html += figure(input.targets[i], silhouettes > 1 || volumes > 0 ? "first" : "");
    for (std::size_t k = 2 * i; k < std::min(2 * i + 2, input.outcomes.size()); ++k)
      html += figure(input.outcomes[k], "");
  }
  return html;
}

std::string score_html(const Explanation& explanation) {
  double largest = 0;
  for (const Explanation& target : explanation.targets) {
    for (const Term& term : target.terms) largest = std::max(largest, std::fabs(term.value * target.weight));
  }
  std::string html;
  for (const Explanation& target : explanation.targets) {
    html += fmt::format(
        "<table class=\"terms\">\n<caption><b>{}</b>{}</caption>\n<thead><tr><th scope=\"col\">term</th>"
        "<th scope=\"col\">counted</th><th scope=\"col\">weight</th><th scope=\"col\">adds</th>"
        "<th><span class=\"unseen\">bar</span></th></tr></thead>\n<tbody>\n",
        escape_html(target.name), target.words.empty() ? "" : ": " + escape_html(target.words));
    for (const Term& term : target.terms) html += term_row(term, target.weight, largest);
    const double score = target.score * target.weight, best = target.optimum * target.weight;
    html += fmt::format(
        "</tbody>\n<tfoot><tr><th scope=\"row\">together</th><td colspan=\"2\">{}</td>"
        "<td>{}</td><td>{}</td></tr></tfoot>\n</table>\n",
        best > 0 ? "of at most " + readable_number(best) : "", readable_number(score),
        target.percent ? fmt::format("{:.1f}&thinsp;%", *target.percent) : "");
  }
  return html;
}

std::string alternatives_html(const ReportInput& input) {
  if (input.live) return "<p>They are chosen when the search has ended.</p>\n";
  CHECK(input.alternatives.size() == input.result.alternatives.size());
  if (input.alternatives.empty()) return "<p>None were kept.</p>\n";
  std::string html = "<ul class=\"thumbnails\">\n";
  for (std::size_t i = 0; i < input.alternatives.size(); ++i) html += alternative_item(input, i);
  return html + "</ul>\n";
}

std::string provenance_html(const ReportInput& input) {
  const Provenance& p = input.provenance;
  std::string html = "<dl>\n";
  html += hash_row("version", p.version);
  html += hash_row("engine", p.engine);
  html += hash_row("seed", fmt::format("{}", p.seed));
  html += hash_row("steps", fmt::format("{}", p.steps));
  html += hash_row("best derivation", p.derivation);
  for (const auto& [name, hash] : p.inputs) html += hash_row(name, hash);
  return html + "</dl>\n";
}

}  // namespace espalier
