// espalier compare: engines, or any settings, side by side on one scene.
#include "run/compare.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/counted.h"
#include "cmd/contest_words.h"
#include "cmd/interrupt.h"
#include "cmd/text_table.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/contest_html.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

std::string score_text(double score, double optimum) {
  if (!std::isfinite(score)) return "-";
  return optimum > 0 ? fmt::format("{:.1f} %", 100 * score / optimum) : fmt::format("{:.6g}", score);
}

std::string spent_text(Effort effort, double spent) {
  return effort == Effort::seconds ? fmt::format("{:.3g} s", spent) : grouped(static_cast<std::uint64_t>(spent));
}

std::vector<VariantWords> variants_of(const CompareOptions& options) {
  std::vector<VariantWords> variants;
  if (!options.engines.empty() || options.variants.empty()) {
    variants = parse_engines(options.engines.empty() ? "ga,smc,sosmc,rjmcmc,hybrid" : options.engines);
  }
  for (const std::string& text : options.variants) variants.push_back(parse_variant(text));
  return variants;
}

std::string command_again(const CompareOptions& options) {
  std::string text = "espalier compare " + shell_word(options.scene);
  if (!options.engines.empty()) text += " --engines " + shell_word(options.engines);
  for (const std::string& variant : options.variants) text += " --variant " + shell_word(variant);
  text += options_again(options);
  if (!options.marks.empty()) text += " --marks " + shell_word(options.marks);
  return text;
}

void print_marks(const Contest& contest, const CompareResult& result) {
  TextTable table({{"after"}, {"variant"}, {"median", true}, {"mean", true}, {"deviation", true}, {"quartiles", true},
                   {"least", true}, {"most", true}, {"p", true}});
  for (const CompareMark& mark : result.summary.marks) {
    for (const std::size_t v : mark.ranking) {
      const SampleSummary& s = mark.scores[v];
      const bool first = v == mark.ranking[0];
      const auto text = [&](double value) { return score_text(value, result.optimum); };
      table.add({first ? spent_text(result.summary.effort, mark.at) : "", contest.variants[v].name, text(s.median),
                 text(s.mean), std::isfinite(s.mean) ? text(s.deviation) : "-", text(s.iqr()), text(s.min), text(s.max),
                 first ? "" : chance_in_words(mark.chance[v])});
    }
  }
  fmt::print("\n{}", table.text(110));
}

void print_words(const Contest& contest, const CompareResult& result) {
  fmt::print("\n");
  const std::string interruption = interruption_in_words(contest, result);
  if (!interruption.empty()) fmt::print("{}\n", interruption);
  for (const CompareMark& mark : result.summary.marks) {
    fmt::print("after {}: {}{}\n", spent_text(result.summary.effort, mark.at), contest.variants[mark.ranking[0]].name,
               told_apart_in_words(contest, mark));
  }
  if (contest.variants.size() < 2) return;
  const std::size_t seeds = result.summary.counted.size();
  fmt::print("p: rank test against the first, corrected for {} by Holm; with {} it cannot be below {}\n",
             counted(contest.variants.size() - 1, "test"), counted(seeds, "seed"),
             chance_in_words(least_chance(seeds, contest.variants.size())));
}

void print_reach(const Contest& contest, const CompareResult& result) {
  const CompareSummary& summary = result.summary;
  std::vector<TextColumn> columns = {{"until it passed the last median of"}};
  for (const ContestVariant& variant : contest.variants) columns.push_back({variant.name, true});
  columns.push_back({"evaluations/s", true});
  TextTable table(columns);
  const auto& rows = summary.reach[static_cast<std::size_t>(summary.effort)];
  for (std::size_t who = 0; who < rows.size(); ++who) {
    std::vector<std::string> cells = {contest.variants[who].name};
    for (const CompareReach& reach : rows[who]) {
      cells.push_back(reach.median ? spent_text(summary.effort, *reach.median)
                                   : reach.reached > 0 ? fmt::format("{} of {}", reach.reached, reach.of) : "-");
    }
    cells.push_back(grouped(static_cast<std::uint64_t>(std::llround(summary.evaluations_per_second[who]))));
    table.add(cells);
  }
  fmt::print("\n{}", table.text(130));
}

void print_json(const CompareResult& result, const Contest& contest, const std::string& page) {
  const nlohmann::ordered_json event = {{"event", "finished"},
                                        {"folder", result.folder},
                                        {"page", page},
                                        {"result", nlohmann::ordered_json::parse(compare_json(contest, result))}};
  fmt::print("{}\n", event.dump());
}

}  // namespace

int compare_verb(const CompareOptions& options) {
  CompareRequest request;
  request.contest = make_contest(contest_words(options), variants_of(options), false);
  const SceneBudget& budget = request.contest.budget;
  request.marks = options.marks.empty() ? default_marks(budget) : parse_marks(options.marks, budget);
  request.command = command_again(options);
  request.out = contest_folder(options, "compare");
  request.threads = options.threads;
  const std::unique_ptr<ContestObserver> observer = make_contest_observer(options.json);
  request.observer = observer.get();
  request.stop = stop_on_signals();
  AssimpMeshSource source;
  const std::optional<CompareResult> result = compare_variants(request, source);
  if (!result) {
    fmt::print(stderr, "espalier: interrupted before there was any result\n");
    return kDiffers;
  }
  const std::string page = (fs::path(result->folder) / "compare.html").string();
  if (options.json) {
    print_json(*result, request.contest, page);
    return kDone;
  }
  print_marks(request.contest, *result);
  print_words(request.contest, *result);
  print_reach(request.contest, *result);
  if (result->failed > 0) fmt::print("\n{}", failed_in_words(result->failed));
  fmt::print("\nwrote {}\nwrote {}\n", page, (fs::path(result->folder) / "compare.csv").string());
  return kDone;
}

}  // namespace espalier
