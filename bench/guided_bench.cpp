// Guiding curves: what a bone costs to judge, and what growing towards curves costs a step (issue numbers in
// docs/performance.md). The benchmark's tree, curves and settings are those of bench/guided_benchmark.toml.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "base/random.h"
#include "io/mesh_import.h"
#include "model/expand.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"
#include "run/setup.h"
#include "score/curve_cost.h"
#include "search/guided.h"

namespace espalier {
namespace {

std::unique_ptr<Setup> load(const char* scene) {
  AssimpMeshSource source;
  return set_up(load_scene(std::string(ESPALIER_SOURCE_DIR) + "/" + scene, {}), source);
}

double coordinate(RandomStream& random) { return 4 * random.next_unit() - 2; }

Vec3 point(RandomStream& random) { return Vec3(coordinate(random), coordinate(random), coordinate(random)); }

CurveSettings random_curves(std::size_t count, std::uint32_t field_cells) {
  RandomStream random({7, Purpose::test});
  CurveSettings settings;
  settings.field_cells = field_cells;
  settings.curves.resize(count);
  for (GuidingCurve& guide : settings.curves) {
    for (Vec3& p : guide.curve.points) p = point(random);
  }
  return settings;
}

/// Items are bones: nearest curve, distance, alignment, segments. Arguments: curves, cells of the field (0: exact).
void bone_cost(benchmark::State& state) {
  const CurveCost cost(random_curves(static_cast<std::size_t>(state.range(0)), static_cast<std::uint32_t>(state.range(1))));
  RandomStream random({8, Purpose::test});
  std::vector<std::pair<Vec3, Vec3>> bones(1000);
  for (auto& [from, to] : bones) {
    from = point(random);
    to = from + 0.15f * point(random);
  }
  CurveTally tally;
  cost.reset(tally);
  for (auto _ : state) {
    for (const auto& [from, to] : bones) cost.add_bone(from, to, tally);
    benchmark::DoNotOptimize(tally.cost);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bones.size()));
}
BENCHMARK(bone_cost)->Args({5, 0})->Args({5, 32})->Args({2, 0})->Args({2, 32});

/// A search of so many particle-steps, another seed each time; items are particle-steps, `cost` is the median of what
/// was found. Arguments: particle-steps; particles of the first step, and of the last (0: the benchmark's own).
void search_of(benchmark::State& state, const char* scene, bool whole) {
  const auto setup = load(scene);
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor);
  Expander expander(setup->graph());
  Model model;
  GuidedSettings settings = setup->scene.search.guided;
  if (state.range(1) > 0) settings.particles = static_cast<std::uint32_t>(state.range(1));
  if (state.range(2) > 0) settings.last_particles = static_cast<std::uint32_t>(state.range(2));
  const auto budget = static_cast<std::uint64_t>(state.range(0));
  std::uint64_t seed = 0;
  std::int64_t steps = 0;
  std::vector<double> costs, parts;
  for (auto _ : state) {
    GuidedEngine engine({setup->grammar.graph, {}, &scorer, ++seed, 0}, settings);
    do engine.step();
    while (engine.evaluations() < budget);
    costs.push_back(-engine.best().score);
    steps += static_cast<std::int64_t>(engine.evaluations());
    if (!whole) continue;
    expander.expand(engine.best().derivation, ExpandTo::full, model);
    parts.push_back(static_cast<double>(model.instances.size()));
  }
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  state.SetItemsProcessed(steps);
  state.counters["cost"] = median(costs);
  if (whole) state.counters["parts"] = median(parts);
}
BENCHMARK_CAPTURE(search_of, benchmark, "bench/guided_benchmark.toml", false)
    ->Args({5600, 0, 0})->Args({5600, 100, 15})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search_of, whole_model, "scenes/guided-tree.toml", true)
    ->Args({5600, 20, 8})->Unit(benchmark::kMillisecond);

/// Items are steps of a search that pauses: the longest time for which nobody can stop it.
void one_step(benchmark::State& state) {
  const auto setup = load("bench/guided_benchmark.toml");
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup->graph(), setup->objective, *executor);
  GuidedSettings settings = setup->scene.search.guided;
  settings.particles = static_cast<std::uint32_t>(state.range(0));
  settings.last_particles = settings.particles;
  GuidedEngine engine({setup->grammar.graph, {}, &scorer, 1, 0}, settings);
  for (auto _ : state) engine.step();
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(one_step)->Arg(100)->Arg(1000);

}  // namespace
}  // namespace espalier
