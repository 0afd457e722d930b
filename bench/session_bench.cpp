// What sessions save RJMCMC on volumes: proposals per second of whole chains, beside the same chains that score whole
// models. Every scene begins with a model of so many genes, and stays about as large: the chains are cold.

#include <benchmark/benchmark.h>

#include "base/check.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "io/mesh_import.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"
#include "run/setup.h"
#include "search/rjmcmc.h"

namespace espalier {
namespace {

std::unique_ptr<Setup> load(const char* scene) {
  AssimpMeshSource source;
  const std::string path = std::string(ESPALIER_SOURCE_DIR) + "/scenes/" + scene;
  return set_up(load_scene(path, {{"limits.genes.max=5000"}, {}}), source);
}

/// An acceptable model of at least so many genes.
Individual large(const Setup& setup, std::size_t genes, SceneScorer& scorer) {
  for (std::uint32_t number = 0; number < 1000; ++number) {
    RandomStream random({1, Purpose::test, 0, number});
    Individual made;
    made.derivation = seedling(setup.graph(), random);
    close_open_slots(setup.graph(), made.derivation, random);
    for (int i = 0; i < 100'000 && made.derivation.size() < genes; ++i) {
      grow(setup.graph(), made.derivation, {}, random);
    }
    const Derivation* const batch = &made.derivation;
    scorer.score({&batch, 1}, {&made.score, 1});
    if (made.derivation.size() >= genes && made.score != kNotAcceptable) return made;
  }
  CHECK(false);
  return {};
}

/// Items are proposals. Arguments: genes at first, chains, with sessions or without.
void chains(benchmark::State& state, const char* scene) {
  const auto setup = load(scene);
  const auto genes = static_cast<std::uint32_t>(state.range(0));
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor, state.range(2) != 0 ? kSessionBytes : 0);
  RjmcmcSettings settings;
  settings.chains = static_cast<std::uint32_t>(state.range(1));
  settings.temperatures = 1;
  settings.genes = {genes / 2, 2 * genes};
  settings.initial_length_min = settings.initial_length_max = genes;
  settings.temperature = 1e-6 * scorer.optimum();
  SearchProblem problem{setup->grammar.graph, {}, &scorer, 1, 0};
  problem.founders.assign(settings.chains, large(*setup, genes, scorer));
  RjmcmcEngine engine(problem, settings);
  for (int i = 0; i < 20; ++i) engine.step();
  const std::uint64_t before = engine.evaluations();
  for (auto _ : state) engine.step();
  state.SetItemsProcessed(static_cast<std::int64_t>(engine.evaluations() - before));
  state.counters["genes"] = static_cast<double>(engine.population().front().derivation.size());
}

void with_and_without(benchmark::internal::Benchmark* bench, std::initializer_list<int> genes) {
  for (const int n : genes) {
    for (const int of : {1, 16}) bench->Args({n, of, 0})->Args({n, of, 1});
  }
  bench->ArgNames({"genes", "chains", "sessions"})->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(chains, spaceship, "spaceship.toml")->Apply([](auto* b) { with_and_without(b, {12, 50, 500}); });
BENCHMARK_CAPTURE(chains, tree, "tree-crown.toml")->Apply([](auto* b) { with_and_without(b, {1000}); });
BENCHMARK_CAPTURE(chains, citadel, "citadel.toml")->Apply([](auto* b) { with_and_without(b, {1000}); });

}  // namespace
}  // namespace espalier
