// What a generation of the breeding room is made of, in the order in which a person waits for it: candidates are judged,
// models are made into messages, derivations become text and come back. Items are individuals; one thread.

#include <benchmark/benchmark.h>

#include "breed/newcomer.h"
#include "derivation/encode.h"
#include "studio/bred_model.h"
#include "studio/breeding_bench.h"
#include "studio/breeding_settings.h"
#include "studio/shipped.h"

namespace espalier::studio {
namespace {

constexpr std::uint32_t kPopulation = 20;

/// Twenty viable individuals of a sample.
struct Room {
  std::unique_ptr<Executor> executor = make_serial_executor();
  NewProject project;
  BreedingBench bench;
  std::vector<Derivation> shown;

  explicit Room(const std::string& sample)
      : project(make_sample(sample)), bench([this](const std::string& hash) { return project.blobs.at(hash); }, *executor) {
    bench.take(project.state);
    const BreedProblem problem = bench.problem(complete({}), 1, {});
    for (std::uint32_t number = 0; shown.size() < kPopulation; ++number) {
      RandomStream random({1, Purpose::test, 0, number});
      const Derivation drawn = draw_newcomer(bench.graph(), random);
      const Derivation* const one = &drawn;
      if (problem.appraiser->appraise({&one, 1})[0].viable) shown.push_back(drawn);
    }
  }
};

void judge(benchmark::State& state, const char* sample) {
  Room room(sample);
  const BreedProblem problem = room.bench.problem(complete({}), 1, {});
  std::vector<const Derivation*> all;
  for (const Derivation& one : room.shown) all.push_back(&one);
  for (auto _ : state) benchmark::DoNotOptimize(problem.appraiser->appraise(all));
  state.SetItemsProcessed(state.iterations() * kPopulation);
}

void make_models(benchmark::State& state, const char* sample) {
  Room room(sample);
  BredModelMaker maker(room.bench.setup(), room.bench.has_targets(), room.bench.viability(complete({})));
  std::size_t bytes = 0;
  for (auto _ : state) {
    bytes = 0;
    for (const Derivation& one : room.shown) bytes += maker.make(one)->bytes.size();
  }
  state.SetItemsProcessed(state.iterations() * kPopulation);
  state.counters["bytes"] = static_cast<double>(bytes) / kPopulation;
}

void to_text_and_back(benchmark::State& state, const char* sample) {
  Room room(sample);
  for (auto _ : state) {
    for (const Derivation& one : room.shown) benchmark::DoNotOptimize(room.bench.read(encode(room.bench.graph(), one)));
  }
  state.SetItemsProcessed(state.iterations() * kPopulation);
}

BENCHMARK_CAPTURE(judge, gentree, "gentree")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, natural, "gentree-natural")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, arboretum, "arboretum")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_models, gentree, "gentree")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_models, natural, "gentree-natural")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_models, arboretum, "arboretum")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(to_text_and_back, gentree, "gentree")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(to_text_and_back, natural, "gentree-natural")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(to_text_and_back, arboretum, "arboretum")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace espalier::studio
