// How long the genetic operations take: copying, crossing over, moves, JSON. Answers are checked before they are timed.
// Individuals are spaceships and guarded trees, grown gene by gene to an exact size, and corals, sampled from a prior
// without bounds until they have it: these are bushy and may be large.

#include <cstdlib>
#include <map>
#include <vector>

#include <benchmark/benchmark.h>

#include "base/check.h"
#include "base/random.h"
#include "derivation/encode.h"
#include "derivation/moves.h"
#include "derivation/sample.h"

namespace espalier {
namespace {

EdgeId add_edge(GeneratorGraph& graph, RuleId parent, RuleId child, double p) {
  Edge edge;
  edge.parent = parent;
  edge.child = child;
  edge.required = p == 1;
  edge.probability = p;
  edge.name = graph.rules[parent].name + "/" + graph.rules[child].name;
  graph.edges.push_back(edge);
  const EdgeId id = static_cast<EdgeId>(graph.edges.size() - 1);
  graph.rules[parent].slots.push_back({graph.rules[child].name, id});
  return id;
}

void add_rule(GeneratorGraph& graph, const char* name, int draws) {
  Rule rule;
  rule.name = name;
  for (int d = 0; d < draws; ++d) rule.draws.push_back({rule.name + ".u", DrawShape::continuous, 0});
  graph.rules.push_back(rule);
}

void add_variants(GeneratorGraph& graph) {
  for (Rule& rule : graph.rules) {
    Variant& all = rule.variants.emplace_back();
    for (std::size_t d = 0; d < rule.draws.size(); ++d) all.draws.push_back(static_cast<std::uint16_t>(d));
    for (std::size_t s = 0; s < rule.slots.size(); ++s) all.slots.push_back(static_cast<std::uint16_t>(s));
  }
}

GeneratorGraph spaceship() {
  GeneratorGraph graph;
  graph.name = "spaceship";
  graph.edges.resize(1);
  add_rule(graph, "Ship", 0), add_rule(graph, "Body", 3), add_rule(graph, "Wing", 4), add_rule(graph, "WingPart", 4);
  add_rule(graph, "Top", 3), add_rule(graph, "TopPart", 3);
  add_edge(graph, 0, 1, 1);
  for (const RuleId child : {1, 2, 4}) add_edge(graph, 1, child, 1.0 / 3);
  add_edge(graph, 2, 3, 0.9), add_edge(graph, 3, 3, 0.9), add_edge(graph, 4, 5, 0.9), add_edge(graph, 5, 5, 0.9);
  add_variants(graph);
  return graph;
}

/// Branches that fork in two with a stem between, to depth 12.
GeneratorGraph tree() {
  using Step = DepthValue::Step;
  GeneratorGraph graph;
  graph.name = "tree";
  graph.edges.resize(1);
  add_rule(graph, "Trunk", 3), add_rule(graph, "Branch", 6), add_rule(graph, "Leader", 5);
  for (const RuleId rule : {0, 1, 2}) {
    const EdgeId fork = add_edge(graph, rule, 1, 1.0 / 3);
    graph.rules[rule].slots.push_back(graph.rules[rule].slots.back());
    graph.rules[rule].slots.back().edge = fork;
    add_edge(graph, rule, 2, 1.0 / 3);
  }
  for (const RuleId rule : {1, 2}) {
    graph.rules[rule].guarded = true;
    graph.rules[rule].guard = DepthValue(std::vector<Step>{{Step::Kind::depth, Arithmetic::add, 0, 0},
                                                           {Step::Kind::constant, Arithmetic::add, 0, 12},
                                                           {Step::Kind::apply, Arithmetic::less, 0, 0}});
  }
  add_variants(graph);
  return graph;
}

/// Three arms at every gene.
GeneratorGraph coral() {
  GeneratorGraph graph;
  graph.name = "coral";
  graph.edges.resize(1);
  add_rule(graph, "Foot", 1), add_rule(graph, "Arm", 3);
  for (int k = 0; k < 3; ++k) add_edge(graph, 0, 1, 0.99), add_edge(graph, 1, 1, 0.6);
  add_variants(graph);
  return graph;
}

enum Kind : std::int64_t { kShip, kTree, kCoral };

const GeneratorGraph& graph_of(std::int64_t kind) {
  static const GeneratorGraph graphs[] = {spaceship(), tree(), coral()};
  return graphs[kind];
}

/// An individual of exactly so many genes.
Derivation individual(std::int64_t kind, std::size_t genes, std::uint32_t number) {
  const GeneratorGraph& graph = graph_of(kind);
  for (std::uint32_t attempt = 0;; ++attempt) {
    RandomStream random({1, Purpose::test, attempt, number, static_cast<std::uint32_t>(genes)});
    Derivation d = kind == kCoral ? sample(graph, random, static_cast<std::uint32_t>(genes)).derivation
                                  : seedling(graph, random);
    CHECK(close_open_slots(graph, d, random));
    while (kind != kCoral && d.size() < genes) CHECK(grow(graph, d, {}, random));
    if (d.size() != genes) continue;
    CHECK(find_fault(graph, d).empty());
    return d;
  }
}

using Gene = std::tuple<RuleId, std::uint16_t, std::vector<std::uint32_t>>;

void count_genes(const GeneratorGraph& graph, const Derivation& d, int by, std::map<Gene, int>& counts) {
  auto draw = d.draws.begin();
  for (const GeneRecord& gene : d.genes) {
    const auto end = draw + static_cast<std::ptrdiff_t>(variant_of(graph, gene).draws.size());
    counts[{graph.edges[gene.edge].child, gene.variant, std::vector<std::uint32_t>(draw, end)}] += by;
    draw = end;
  }
}

/// Children hold exactly their parents' genes and are valid.
void check_crossover(const GeneratorGraph& graph, const std::vector<Derivation>& parents,
                     const CrossoverSettings& settings) {
  RandomStream random({2, Purpose::test});
  Derivation child1, child2;
  for (int i = 0; i < 20; ++i) {
    const Derivation& p1 = parents[random.below(static_cast<std::uint32_t>(parents.size()))];
    const Derivation& p2 = parents[random.below(static_cast<std::uint32_t>(parents.size()))];
    crossover(graph, p1, p2, {}, {}, settings, random, child1, child2);
    CHECK(find_fault(graph, child1).empty() && find_fault(graph, child2).empty());
    std::map<Gene, int> counts;
    count_genes(graph, p1, 1, counts), count_genes(graph, p2, 1, counts);
    count_genes(graph, child1, -1, counts), count_genes(graph, child2, -1, counts);
    for (const auto& [gene, count] : counts) CHECK(count == 0);
  }
}

std::vector<Derivation> parents_of(std::int64_t kind, std::size_t genes) {
  std::vector<Derivation> parents;
  const std::uint32_t n = genes > 5000 ? 2 : 8;
  for (std::uint32_t i = 0; i < n; ++i) parents.push_back(individual(kind, genes, i));
  return parents;
}

/// Both children, storage reused: copying and crossing over at once. Args: kind, genes.
void crossover_by(benchmark::State& state, Compatibility compatibility) {
  const GeneratorGraph& graph = graph_of(state.range(0));
  const std::vector<Derivation> parents = parents_of(state.range(0), static_cast<std::size_t>(state.range(1)));
  CrossoverSettings settings;
  settings.compatibility = compatibility;
  check_crossover(graph, parents, settings);
  RandomStream random({3, Purpose::test});
  Derivation child1, child2;
  std::size_t i = 0, crossed = 0;
  for (auto _ : state) {
    const Derivation& p1 = parents[i % parents.size()];
    const Derivation& p2 = parents[(i * 3 + 1) % parents.size()];
    ++i;
    crossed += crossover(graph, p1, p2, {}, {}, settings, random, child1, child2).crossed;
    benchmark::DoNotOptimize(child1.draws.data());
    benchmark::DoNotOptimize(child2.draws.data());
  }
  CHECK(crossed > 0);
  state.counters["crossed"] = static_cast<double>(crossed) / static_cast<double>(i);
}

void crossover_by_edge(benchmark::State& state) { crossover_by(state, Compatibility::edge); }
void crossover_by_symbol(benchmark::State& state) { crossover_by(state, Compatibility::symbol); }

void copy(benchmark::State& state) {
  const Derivation parent = individual(state.range(0), static_cast<std::size_t>(state.range(1)), 0);
  Derivation child = parent;
  CHECK(child == parent);
  for (auto _ : state) {
    child = parent;
    benchmark::DoNotOptimize(child.draws.data());
    benchmark::ClobberMemory();
  }
}

using Move = bool (*)(const GeneratorGraph&, Derivation&, const Locks&, RandomStream&);

/// A copy and one move.
void copy_and_move(benchmark::State& state, Move move) {
  const GeneratorGraph& graph = graph_of(state.range(0));
  const Derivation parent = individual(state.range(0), static_cast<std::size_t>(state.range(1)), 0);
  RandomStream random({4, Purpose::test});
  Derivation child = parent;
  CHECK(move(graph, child, {}, random) && find_fault(graph, child).empty() && !(child == parent));
  for (auto _ : state) {
    child = parent;
    benchmark::DoNotOptimize(move(graph, child, {}, random));
  }
}

void copy_and_grow(benchmark::State& state) { copy_and_move(state, grow); }
void copy_and_cut(benchmark::State& state) { copy_and_move(state, cut); }
void copy_and_alter(benchmark::State& state) { copy_and_move(state, alter); }

void json_round_trip(benchmark::State& state) {
  const GeneratorGraph& graph = graph_of(state.range(0));
  const Derivation d = individual(state.range(0), static_cast<std::size_t>(state.range(1)), 0);
  CHECK(decode(graph, encode(graph, d)) == d);
  for (auto _ : state) benchmark::DoNotOptimize(decode(graph, encode(graph, d)));
}

void json_encode(benchmark::State& state) {
  const GeneratorGraph& graph = graph_of(state.range(0));
  const Derivation d = individual(state.range(0), static_cast<std::size_t>(state.range(1)), 0);
  for (auto _ : state) benchmark::DoNotOptimize(encode(graph, d));
}

void prior(benchmark::State& state) {
  const GeneratorGraph& graph = graph_of(state.range(0));
  const Derivation d = individual(state.range(0), static_cast<std::size_t>(state.range(1)), 0);
  CHECK(log_prior(graph, d) < 0);
  for (auto _ : state) benchmark::DoNotOptimize(log_prior(graph, d));
}

void sample_prior(benchmark::State& state) {
  const GeneratorGraph& graph = graph_of(state.range(0));
  RandomStream random({5, Purpose::test});
  std::size_t genes = 0;
  for (auto _ : state) genes += sample(graph, random).derivation.size();
  state.counters["genes"] = static_cast<double>(genes) / static_cast<double>(state.iterations());
}

void both_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({kShip, 500})->Args({kTree, 500})->Args({kCoral, 500})->Args({kCoral, 50000});
}

BENCHMARK(copy)->Apply(both_sizes);
BENCHMARK(crossover_by_edge)->Apply(both_sizes);
BENCHMARK(crossover_by_symbol)->Apply(both_sizes);
BENCHMARK(copy_and_grow)->Apply(both_sizes);
BENCHMARK(copy_and_cut)->Apply(both_sizes);
BENCHMARK(copy_and_alter)->Apply(both_sizes);
BENCHMARK(prior)->Apply(both_sizes);
BENCHMARK(json_encode)->Apply(both_sizes)->Unit(benchmark::kMillisecond);
BENCHMARK(json_round_trip)->Apply(both_sizes)->Unit(benchmark::kMillisecond);
BENCHMARK(sample_prior)->Arg(kShip)->Arg(kTree);

}  // namespace
}  // namespace espalier
