// Pictures: a whole render() of 800 x 600 of a tree of 10 000 parts (must: 1 s on two cores; aim: 0.2 s), one with
// leaves, a town, and parts that lie almost in one place, which no tree of boxes can part.

#include <functional>

#include <benchmark/benchmark.h>

#include "base/check.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "io/mesh_import.h"
#include "model/expand.h"
#include "render/render.h"
#include "run/grammar_file.h"

namespace espalier {
namespace {

struct Subject {
  LoadedGrammar grammar;
  MeshTable meshes;
  Model model;
};

Subject grown(const std::string& name, const std::map<std::string, std::string>& attributes, std::size_t genes,
              const std::function<void(Derivation&)>& edit = {}) {
  LoadedGrammar grammar = load_grammar(std::string(ESPALIER_SOURCE_DIR) + "/grammars/" + name, attributes);
  AssimpMeshSource source;
  MeshTable meshes = load_meshes(grammar, source);
  const GeneratorGraph& graph = *grammar.graph;
  RandomStream random({1, Purpose::test});
  Derivation derivation = seedling(graph, random);
  close_open_slots(graph, derivation, random);
  while (derivation.size() < genes) CHECK(grow(graph, derivation, {}, random));
  if (edit) edit(derivation);
  Model model;
  Expander(graph).expand(derivation, ExpandTo::full, model);
  return {std::move(grammar), std::move(meshes), std::move(model)};
}

// Three branches, eight levels: 9841 spans.
void make_large(Derivation& derivation) {
  const auto eighth = [](int k) { return static_cast<std::uint32_t>((2 * k + 1) * (0x1p32 / 16)); };
  derivation.draws[0] = eighth(2), derivation.draws[5] = eighth(6);
  derivation.draws[10] = derivation.draws[11] = 0;
}

void draw(benchmark::State& state, const Subject& subject) {
  TextureTable textures = load_textures(subject.grammar);
  const Surfaces surfaces(*subject.grammar.graph, subject.model, textures);
  RenderSettings settings;
  settings.width = 800, settings.height = 600;
  const auto executor = make_tbb_executor(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const Picture picture = render(subject.model, subject.meshes, surfaces, {}, settings, *executor);
    benchmark::DoNotOptimize(picture.rgb.data());
  }
  state.counters["parts"] = static_cast<double>(subject.model.instances.size());
}

void render_tree(benchmark::State& state) {
  static const Subject tree = grown("gentree.esp", {{"leafy", "false"}}, 1, make_large);
  draw(state, tree);
}
BENCHMARK(render_tree)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void render_leafy_tree(benchmark::State& state) {
  static const Subject tree = grown("gentree-natural.esp", {}, 1, make_large);
  draw(state, tree);
}
BENCHMARK(render_leafy_tree)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void render_town(benchmark::State& state) {
  static const Subject town = grown("citadel.esp", {}, 500);
  draw(state, town);
}
BENCHMARK(render_town)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

// The town many times over, each a hair's breadth from the last.
void render_nearly_coincident(benchmark::State& state) {
  static const Subject pile = [] {
    Subject town = grown("citadel.esp", {}, 20);
    const std::vector<Instance> once = town.model.instances;
    town.model.instances.clear();
    for (int copy = 0; town.model.instances.size() < 10'000; ++copy) {
      for (Instance instance : once) {
        instance.model_from_mesh.origin += Vec3(1e-5f * static_cast<float>(copy));
        town.model.instances.push_back(instance);
      }
    }
    return town;
  }();
  draw(state, pile);
}
BENCHMARK(render_nearly_coincident)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace espalier
