// Expansion: time per gene, against the must of 60 ns and the aim of 20 ns; and a derivation of 50 000 genes (must: 3 ms).

#include <fstream>
#include <sstream>

#include <benchmark/benchmark.h>

#include "base/check.h"
#include "derivation/encode.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "model/expand.h"

namespace espalier {
namespace {

std::shared_ptr<const GeneratorGraph> load(const std::string& name) {
  std::ifstream file(std::string(ESPALIER_SOURCE_DIR) + "/grammars/" + name);
  std::stringstream text;
  text << file.rdbuf();
  const auto graph = compile_grammar({name, text.str(), {}}).graph;
  CHECK(graph);
  return graph;
}

Derivation grown(const GeneratorGraph& graph, std::size_t genes) {
  RandomStream random({1, Purpose::test});
  Derivation derivation = seedling(graph, random);
  close_open_slots(graph, derivation, random);
  while (derivation.size() < genes) CHECK(grow(graph, derivation, {}, random));
  return derivation;
}

void expand_per_gene(benchmark::State& state, const char* name) {
  const auto graph = load(name);
  const Derivation derivation = grown(*graph, static_cast<std::size_t>(state.range(0)));
  CHECK(find_fault(*graph, derivation).empty());
  Expander expander(*graph);
  Model model;
  for (auto _ : state) {
    expander.expand(derivation, ExpandTo::parts, model);
    benchmark::DoNotOptimize(model.instances.data());
  }
  CHECK(model.instances.size() >= derivation.size() / 2);
  state.counters["s_per_gene"] = benchmark::Counter(static_cast<double>(derivation.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["parts"] = static_cast<double>(model.instances.size());
}
BENCHMARK_CAPTURE(expand_per_gene, spaceship, "spaceship.esp")->Arg(50)->Arg(500)->Arg(5000);
BENCHMARK_CAPTURE(expand_per_gene, citadel, "citadel.esp")->Arg(50)->Arg(500);

// A tree deep enough to hold 50 000 genes: the spaceship's would take minutes to grow gene by gene.
void expand_50000_genes(benchmark::State& state) {
  const auto graph = compile_grammar({"wide.esp", R"(grammar wide 1
start S
rule S { for k in 0..199 { spawn A } }
rule A { k ~ uniform(vec(0.5), vec(1))  resize k  move y scope.y / 2  emit box  for i in 0..248 { turn y 1deg  spawn B } }
rule B { s ~ uniform(0.1, 0.2)  move x s  emit box }
)", {}}).graph;
  CHECK(graph);
  RandomStream random({1, Purpose::test});
  const Derivation derivation = sample(*graph, random, 60'000).derivation;
  CHECK(derivation.size() == 1 + 200 + 200 * 249);
  Expander expander(*graph);
  Model model;
  for (auto _ : state) {
    expander.expand(derivation, ExpandTo::parts, model);
    benchmark::DoNotOptimize(model.instances.data());
  }
  state.counters["s_per_gene"] = benchmark::Counter(static_cast<double>(derivation.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(expand_50000_genes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace espalier
