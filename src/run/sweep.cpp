#include "run/sweep.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/counted.h"
#include "io/file.h"
#include "run/results.h"
#include "run/thinned.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSteps = 512;  // kept of a search: more than a chart shows

std::vector<StepReport> thinned(const std::vector<StepReport>& steps) {
  Thinned<StepReport> few(kMostSteps);
  for (const StepReport& step : steps) few.add(step.step - 1, step);
  std::vector<StepReport> kept;
  for (const auto& [number, step] : few.rows()) kept.push_back(step);
  return kept;
}

/// The best of every combination is held until it is known which of them is the best.
void take_outcome(const Contest& contest, ContestOutcome outcome, SweepResult& result,
                  std::vector<std::optional<ContestBest>>& bests) {
  keep_best(bests[outcome.variant], outcome);
  const auto seed = std::find(contest.seeds.begin(), contest.seeds.end(), outcome.seed) - contest.seeds.begin();
  outcome.best.derivation = {};
  outcome.steps = thinned(outcome.steps);
  outcome.rises = {};
  std::optional<ContestOutcome>& place = result.combinations[outcome.variant].searches[static_cast<std::size_t>(seed)];
  place = std::move(outcome);
}

/// The scene with the values of the best combination, its inputs named as in the folder.
std::string best_scene(const SweepRequest& request, const Setup& setup) {
  Scene scene = setup.scene;
  scene.seed = request.contest.seeds[0];
  scene.output = request.contest.variants[0].scene.output;
  return "# The scene with the values that did best in a sweep. `espalier run` searches with them.\n" + to_toml(scene);
}

void write_sweep(const SweepRequest& request, const SweepResult& result, ContestSetups& setups,
                 const ContestBest& best, Executor& executor, RunFolder& folder) {
  const std::size_t first = result.ranking[0];
  Setup& setup = setups.of(first);
  const std::string scene = best_scene(request, setup);
  BestFiles files_of_best(setup, request.contest.variants[first], best, executor);
  std::vector<FolderFile> files;
  const auto text = [&](const char* name, std::string (*make)(const SweepRequest&, const SweepResult&)) {
    files.emplace_back(name, [&, make](const std::string& path) { write_file(path, make(request, result)); });
  };
  text(kSweepMarker, sweep_json);
  text("sweep.csv", sweep_csv);
  text("effects.csv", sweep_effects_csv);
  if (request.curves) text("curves.csv", sweep_curves_csv);
  files.emplace_back("best.toml", [&](const std::string& path) { write_file(path, scene); });
  files.emplace_back("inputs", [&](const std::string& path) {
    setup.inputs.write(fs::path(path).parent_path().string());
  });
  for (const char* name : {"best.derivation.json", "best.glb"})
    files.emplace_back(name, [&](const std::string& path) { files_of_best.write(path); });
  files.emplace_back("best.png", [&](const std::string& path) { files_of_best.write_picture(path); });
  files.emplace_back("sweep.html", [&](const std::string& path) {
    write_file(path, sweep_page(request, result, {scene, &files_of_best.picture(), &best, &setup.inputs}));
  });
  write_folder(folder, files);
}

/// The first few in words: the rest say the same.
void add_failures(const Contest& contest, SweepResult& result) {
  constexpr std::size_t kMost = 10;
  std::size_t told = 0, untold = 0;
  for (std::size_t i = 0; i < result.combinations.size(); ++i) {
    const std::string failures = failures_in_words(contest.variants[i].name, result.combinations[i].searches);
    result.failed += failed_of(result.combinations[i].searches);
    if (failures.empty()) continue;
    if (told == kMost) ++untold;
    else result.warnings.push_back(failures), ++told;
  }
  if (untold == 0) return;
  result.warnings.push_back(fmt::format("of {} more some or all came to nothing", counted(untold, "combination")));
}

}  // namespace

std::optional<SweepResult> sweep_settings(const SweepRequest& request, MeshSource& source) {
  const Contest& contest = request.contest;
  ContestObserver silent;
  ContestObserver& observer = request.observer ? *request.observer : silent;
  const std::unique_ptr<Executor> executor = make_tbb_executor(request.threads);
  ContestSetups setups(contest, source);
  Setup& first = setups.first();
  RunFolder folder(request.out, kSweepMarker);
  observer.started(contest_start("sweep", request.contest, first, folder.path(), executor->workers()));
  SweepResult result;
  begin_result(contest, setups, folder.path(), executor->workers(), result);
  result.combinations.resize(contest.variants.size());
  for (SweepCombination& combination : result.combinations) combination.searches.resize(contest.seeds.size());
  for (const std::string& warning : result.warnings) observer.warning(warning);

  std::vector<std::optional<ContestBest>> bests(contest.variants.size());
  ContestControl control;
  control.stop = request.stop, control.watcher = &observer;
  result.interrupted = !run_contest(contest, setups, *executor, control, [&](ContestOutcome outcome) {
    take_outcome(contest, std::move(outcome), result, bests);
  });
  if (std::none_of(bests.begin(), bests.end(), [](const auto& best) { return best.has_value(); })) return std::nullopt;
  add_failures(contest, result);
  summarise_sweep(request, result);
  // Where nothing has a median, what found anything comes before what found nothing.
  std::stable_partition(result.ranking.begin(), result.ranking.end(),
                        [&](std::size_t i) { return bests[i].has_value(); });
  observer.writing();
  write_sweep(request, result, setups, *bests[result.ranking[0]], *executor, folder);
  observer.written();
  return result;
}

}  // namespace espalier
