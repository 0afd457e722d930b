// Expansion: time per gene, against the must of 60 ns and the aim of 20 ns; and a derivation of 50 000 genes (must: 3
// ms).

#include <benchmark/benchmark.h>

#include "base/check.h"
#include "derivation/encode.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "model/expand.h"
#include "run/grammar_file.h"

namespace espalier {
namespace {

std::shared_ptr<const GeneratorGraph> load(const std::string& name,
                                           const std::map<std::string, std::string>& attributes = {}) {
  const auto graph = compile_grammar_file(std::string(ESPALIER_SOURCE_DIR) + "/grammars/" + name, attributes).graph;
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
  CHECK(model.instances.size() >= derivation.size() / 4);
  state.counters["s_per_gene"] = benchmark::Counter(static_cast<double>(derivation.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["parts"] = static_cast<double>(model.instances.size());
}
BENCHMARK_CAPTURE(expand_per_gene, spaceship, "spaceship.esp")->Arg(50)->Arg(500)->Arg(5000);
BENCHMARK_CAPTURE(expand_per_gene, citadel, "citadel.esp")->Arg(50)->Arg(500);
BENCHMARK_CAPTURE(expand_per_gene, tree_v1, "tree-v1.esp")->Arg(50)->Arg(500);
BENCHMARK_CAPTURE(expand_per_gene, tree_v2, "tree-v2.esp")->Arg(50)->Arg(500);
BENCHMARK_CAPTURE(expand_per_gene, tree_two_branch, "tree-two-branch.esp")->Arg(50)->Arg(500);
BENCHMARK_CAPTURE(expand_per_gene, city, "city.esp")->Arg(50)->Arg(201);
BENCHMARK_CAPTURE(expand_per_gene, city_separate, "city-separate.esp")->Arg(50)->Arg(101);
BENCHMARK_CAPTURE(expand_per_gene, city_filling, "city-filling.esp")->Arg(50)->Arg(500);

// GenTree, all details of one gene: three branches, eight levels, 9841 spans (must: 5 ms for 10 000). And the largest
// tree that its genes allow, which ends by the limits of expansion.
void expand_gentree(benchmark::State& state, int branches, int levels) {
  const auto graph = load("gentree.esp", {{"leafy", "false"}});
  Derivation derivation = grown(*graph, 1);
  const auto eighth = [](int k) { return static_cast<std::uint32_t>((2 * k + 1) * (0x1p32 / 16)); };
  derivation.draws[0] = eighth(branches - 1), derivation.draws[5] = eighth(levels - 2);
  derivation.draws[10] = derivation.draws[11] = 0;  // neither more branches nor fewer levels
  Expander expander(*graph);
  Model model;
  for (auto _ : state) {
    expander.expand(derivation, ExpandTo::full, model);
    benchmark::DoNotOptimize(model.instances.data());
  }
  state.counters["spans"] = static_cast<double>(model.instances.size());
  state.counters["truncated"] = model.truncated;
}
BENCHMARK_CAPTURE(expand_gentree, usual, 3, 8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(expand_gentree, largest, 8, 9)->Unit(benchmark::kMillisecond);

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
