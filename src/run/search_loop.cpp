#include "run/search_loop.h"

#include <chrono>

#include "base/check.h"
#include "run/diversity.h"
#include "run/make_engine.h"
#include "run/scene_scorer.h"

namespace espalier {
namespace {

// Sketching costs about as much as scoring, and populations change slowly.
constexpr std::uint64_t kStepsPerOffer = 10;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Why to stop, empty: go on.
std::string reason_to_stop(const SearchControl& control, const StepReport& report) {
  if (control.stop && control.stop->load()) return "interrupt";
  if (control.exact_steps) return report.step >= *control.exact_steps ? "steps" : "";
  const SceneBudget& budget = control.budget;
  if (budget.generations && report.step >= *budget.generations) return "generations";
  if (budget.evaluations && report.evaluations >= *budget.evaluations) return "evaluations";
  if (budget.seconds && report.seconds >= *budget.seconds) return "seconds";
  return "";
}

// One place more than are kept: the best takes one.
DiverseArchive make_archive(const Setup& setup) {
  return DiverseArchive(ModelSketcher(setup.graph(), setup.stage, setup.full()),
                        std::size_t{setup.scene.output.keep} + 1, setup.scene.output.distance);
}

double mean_score(std::span<const Individual> population) {
  double sum = 0;
  for (const Individual& individual : population) sum += individual.score;
  return sum / static_cast<double>(population.size());
}

}  // namespace

std::optional<SearchResult> run_search(const Setup& setup, const SearchControl& control, Executor& executor) {
  SceneScorer scorer(setup.graph(), setup.objective, executor);
  const SearchProblem problem = {setup.grammar.graph, {}, &scorer, setup.scene.seed, 0};
  const std::unique_ptr<Engine> made = make_engine(setup.scene.search, problem);
  Engine& engine = *made;
  DiverseArchive archive = make_archive(setup);

  SearchResult result;
  const Stopwatch watch;
  while (result.stopped_by.empty()) {
    if (result.steps == 0 && control.stop && control.stop->load()) return std::nullopt;
    engine.step();
    result.steps = engine.steps();
    const StepReport report = {engine.steps(), engine.evaluations(), watch.seconds(), engine.best().score,
                               mean_score(engine.population())};
    result.log.push_back(report);
    if (control.observer) control.observer->step(report);
    if (control.watcher) control.watcher->stepped(report, engine.best());
    result.stopped_by = reason_to_stop(control, report);
    if (report.step % kStepsPerOffer == 1 || !result.stopped_by.empty()) archive.offer(engine.population());
  }
  result.seconds = watch.seconds();
  result.evaluations = engine.evaluations();
  result.diagnostics = engine.diagnostics();
  result.rejections = scorer.rejections();
  result.best = engine.best();
  result.explanation = scorer.explain(result.best.derivation);
  if (setup.scene.output.keep > 0) result.alternatives = archive.apart_from(result.best.derivation);
  return result;
}

}  // namespace espalier
