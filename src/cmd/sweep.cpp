// espalier sweep: a scene with every combination of some settings.
#include "run/sweep.h"

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

constexpr std::size_t kMostRows = 20;  // on the terminal; sweep.csv has all

std::string score_text(double score, double optimum) {
  if (!std::isfinite(score)) return "-";
  return optimum > 0 ? fmt::format("{:.1f} %", 100 * score / optimum) : fmt::format("{:.6g}", score);
}

std::string command_again(const SweepOptions& options) {
  std::string text = "espalier sweep " + shell_word(options.scene);
  for (const std::string& varied : options.varied) text += " --vary " + shell_word(varied);
  if (options.engine) text += " --engine " + shell_word(*options.engine);
  if (options.random) text += fmt::format(" --random {}", *options.random);
  return text + options_again(options) + (options.curves ? " --curves" : "");
}

SweepRequest request_of(const SweepOptions& options) {
  SweepRequest request;
  const ContestWords words = contest_words(options);
  request.varied = parse_varied(options.varied);
  request.combinations = plan_combinations(request.varied, options.random, contest_seeds(words)[0]);
  request.contest = make_contest(words, sweep_variants(request.varied, request.combinations, options.engine), true);
  check_sweep(request.varied, request.contest);
  request.curves = options.curves;
  request.command = command_again(options);
  request.out = contest_folder(options, "sweep");
  request.threads = options.threads;
  return request;
}

void print_table(const SweepRequest& request, const SweepResult& result) {
  std::vector<TextColumn> columns = {{"rank", true}};
  for (const VariedSetting& one : request.varied) columns.push_back({one.key.substr(one.key.rfind('.') + 1), true});
  for (const char* head : {"median", "quartiles", "least", "most", "p"}) columns.push_back({head, true});
  columns.push_back({"seeds", true});
  TextTable table(columns);
  for (std::size_t rank = 0; rank < std::min(kMostRows, result.ranking.size()); ++rank) {
    const std::size_t i = result.ranking[rank];
    const SweepCombination& combination = result.combinations[i];
    std::vector<std::string> cells = {rank == 0 ? "best" : fmt::format("{}", rank + 1)};
    for (std::size_t k = 0; k < request.varied.size(); ++k)
      cells.push_back(request.varied[k].values[request.combinations[i][k]]);
    if (combination.scores) {
      const SampleSummary& s = *combination.scores;
      for (const double value : {s.median, s.iqr(), s.min, s.max}) cells.push_back(score_text(value, result.optimum));
      cells.push_back(rank == 0 ? "" : chance_in_words(combination.chance));
      cells.push_back(fmt::format("{}", s.count));
    } else {
      cells.insert(cells.end(), {"-", "-", "-", "-", "", "0"});
    }
    table.add(cells);
  }
  fmt::print("\n{}", table.text(130));
  if (result.ranking.size() > kMostRows) fmt::print("and {} more\n", result.ranking.size() - kMostRows);
}

/// "10: 55.2 %", "1: - (2 of 3 came to nothing)".
std::string effect_in_words(const SweepEffect& effect, double optimum) {
  if (!effect.medians) return effect.value + ": not searched";
  std::string text = fmt::format("{}: {}", effect.value, score_text(effect.medians->median, optimum));
  if (effect.nothing > 0) text += fmt::format(" ({} of {} came to nothing)", effect.nothing, effect.medians->count);
  return text;
}

void print_effects(const SweepRequest& request, const SweepResult& result) {
  fmt::print("\n");
  for (std::size_t i = 0; i < request.varied.size(); ++i) {
    std::vector<std::string> items;
    for (const SweepEffect& effect : result.effects[i]) {
      items.push_back(effect_in_words(effect, result.optimum));
    }
    const std::optional<double> apart = effect_of(result.effects[i]);
    fmt::print("{}", listed(request.varied[i].key +
                                (apart ? fmt::format(", {} apart:", score_text(*apart, result.optimum)) : ":"), items));
  }
}

}  // namespace

int sweep_verb(const SweepOptions& options) {
  SweepRequest request = request_of(options);
  const std::unique_ptr<ContestObserver> observer = make_contest_observer(options.json);
  request.observer = observer.get();
  request.stop = stop_on_signals();
  AssimpMeshSource source;
  const std::optional<SweepResult> result = sweep_settings(request, source);
  if (!result) {
    fmt::print(stderr, "espalier: interrupted before there was any result\n");
    return kDiffers;
  }
  const std::string page = (fs::path(result->folder) / "sweep.html").string();
  if (options.json) {
    const nlohmann::ordered_json event = {{"event", "finished"},
                                          {"folder", result->folder},
                                          {"page", page},
                                          {"result", nlohmann::ordered_json::parse(sweep_json(request, *result))}};
    fmt::print("{}\n", event.dump());
    return kDone;
  }
  if (result->interrupted) {
    fmt::print("\n{}\n", result->counted.empty() ? "no seed was completed: each is told by what it has"
                                                 : fmt::format("stopped by hand: these are of the {} of {} that all "
                                                               "combinations completed", result->counted.size(),
                                                               counted(request.contest.seeds.size(), "seed")));
  }
  print_table(request, *result);
  print_effects(request, *result);
  fmt::print("\n");
  if (result->failed > 0) fmt::print("{}\n", failed_in_words(result->failed));
  for (const char* name : {"sweep.html", "sweep.csv", "best.toml"})
    fmt::print("wrote {}\n", (fs::path(result->folder) / name).string());
  return kDone;
}

}  // namespace espalier
