#include "run/search_loop.h"

#include <chrono>

#include "base/check.h"
#include "run/diversity.h"
#include "run/scene_scorer.h"
#include "search/ga.h"

namespace espalier {
namespace {

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

double mean_score(std::span<const Individual> population) {
  double sum = 0;
  for (const Individual& individual : population) sum += individual.score;
  return sum / static_cast<double>(population.size());
}

}  // namespace

std::optional<SearchResult> run_search(const Setup& setup, const SearchControl& control, Executor& executor) {
  CHECK(setup.scene.search.engine == "ga");
  SceneScorer scorer(setup.graph(), setup.objective, executor);
  GaEngine engine({setup.grammar.graph, {}, &scorer, setup.scene.seed, 0}, setup.scene.search.ga);
  DiverseArchive archive(setup.graph(), std::size_t{setup.scene.output.keep} + 1, setup.scene.output.distance);

  SearchResult result;
  const Stopwatch watch;
  while (result.stopped_by.empty()) {
    if (result.steps == 0 && control.stop && control.stop->load()) return std::nullopt;
    engine.step();
    archive.offer(engine.population());
    result.steps = engine.steps();
    const StepReport report = {engine.steps(), engine.evaluations(), watch.seconds(), engine.best().score,
                               mean_score(engine.population())};
    result.log.push_back(report);
    if (control.observer) control.observer->step(report);
    result.stopped_by = reason_to_stop(control, report);
  }
  result.seconds = watch.seconds();
  result.evaluations = engine.evaluations();
  result.diagnostics = engine.diagnostics();
  result.best = engine.best();
  result.explanation = scorer.explain(result.best.derivation);
  for (const Individual& member : archive.members()) {
    if (!(member.derivation == result.best.derivation)) result.alternatives.push_back(member);
  }
  // The archive holds the best too, unless nothing is kept.
  if (result.alternatives.size() > setup.scene.output.keep) result.alternatives.resize(setup.scene.output.keep);
  return result;
}

}  // namespace espalier
