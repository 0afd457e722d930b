// Whole searches: evaluations per second of the shipped scenes, and what the genetic algorithm costs beside its scoring
// (aim: below 3 us per evaluation). That the search climbs is checked before anything is timed.

#include <benchmark/benchmark.h>

#include "base/check.h"
#include "io/mesh_import.h"
#include "run/scene_toml.h"
#include "run/search_loop.h"
#include "search/ga.h"

namespace espalier {
namespace {

std::unique_ptr<Setup> load(const char* scene) {
  AssimpMeshSource source;
  return set_up(load_scene(std::string(ESPALIER_SOURCE_DIR) + "/scenes/" + scene), source);
}

SearchResult search(const Setup& setup, std::uint64_t steps, Executor& executor) {
  SearchControl control;
  control.exact_steps = steps;
  return *run_search(setup, control, executor);
}

/// Items are evaluations; the argument is the number of threads.
void search_scene(benchmark::State& state, const char* scene) {
  const auto setup = load(scene);
  const auto executor = make_tbb_executor(static_cast<int>(state.range(0)));
  CHECK(search(*setup, 20, *executor).best.score > search(*setup, 1, *executor).best.score);
  std::uint64_t evaluations = 0;
  for (auto _ : state) evaluations += search(*setup, 100, *executor).evaluations;
  state.SetItemsProcessed(static_cast<std::int64_t>(evaluations));
}
BENCHMARK_CAPTURE(search_scene, spaceship, "spaceship.toml")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search_scene, citadel, "citadel.toml")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Costs next to nothing: what is timed with it is the engine alone.
class DrawScorer final : public BatchScorer {
 public:
  void score(std::span<const Derivation* const> derivations, std::span<double> scores) override {
    for (std::size_t i = 0; i < derivations.size(); ++i) {
      const std::vector<std::uint32_t>& draws = derivations[i]->draws;
      scores[i] = draws.empty() ? 0 : draws[draws.size() / 2] * 0x1p-32;
    }
  }
  double optimum() const override { return 1; }
};

/// Items are evaluations: individuals start with 50 genes.
void engine_alone(benchmark::State& state) {
  const auto setup = load("spaceship.toml");
  DrawScorer scorer;
  GaEngine engine({setup->grammar.graph, {}, &scorer, 1, 0}, ga_preset("ga-2017"));
  for (int i = 0; i < 20; ++i) engine.step();
  const std::uint64_t before = engine.evaluations();
  for (auto _ : state) engine.step();
  state.SetItemsProcessed(static_cast<std::int64_t>(engine.evaluations() - before));
}
BENCHMARK(engine_alone)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace espalier
