// From text to graph. Must: parsing and checking a grammar of 500 lines takes at most 5 ms.

#include <algorithm>

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include "base/check.h"
#include "grammar/checker.h"
#include "grammar/compiler.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

/// `modules` modules of 20 lines: rules with draws, choices, loops and splits, details, functions, constants.
std::string text_of_modules(int modules) {
  std::string text = "grammar large 1\nstart Root\nrule Root { turn y 30deg  spawn Trunk_0 }\n";
  for (int i = 0; i < modules; ++i) {
    const std::string next = i + 1 < modules ? fmt::format("Trunk_{}", i + 1) : "Twig_0";
    text += fmt::format(R"(const step_{0} = {1}.5 * 2
fn ease_{0}(t) = t * t * (3 - 2 * t) / max(1, step_{0})
attr width_{0} in 0.1..4 = 1.5 "Group {0}/Width"
material paint_{0} = surface("#80{2:02x}40", roughness: 0.4)
rule Trunk_{0} {{
  tall ~ uniform(1.4, 1.8)
  spin ~ angle()
  k ~ uniform(vec(0.6), (1.2, width_{0} + 1, 1.2))
  turn y spin  resize k  move y tall * scope.y / 2  paint paint_{0}  emit cone(top: ease_{0}(0.4), sides: 12)
  choose {{
    2: {{ mirror x {{ move x scope.x / 2  maybe 0.4 spawn Twig_{0} }} }}
    1: {{ for k_ in 0..3 {{ turn y 90deg * k_  maybe 0.3 spawn Twig_{0} }} }}
  }}
  move y scope.y / 2  maybe clamp(0.9 - 0.1 * depth, 0.1, 0.8) spawn {3} else detail Leaf_{0}(0.3 + 0.1 * {1})
}}
rule Twig_{0} when depth < 90 {{
  lean ~ normal(30deg, 10deg, 0deg, 60deg)
  turn z lean  bone (0, 0, 0) -> (0, 1, 0)
  split y {{ 10%: {{ emit box }} repeat 0.3: {{ detail Leaf_{0}(0.2) }} ~1: {{ }} }}
  if childless {{ detail Leaf_{0}(0.5) }}
}}
detail Leaf_{0}(s) {{ size s  if s > 0.25 {{ emit leaf }} else {{ emit sphere }} }}
)", i, i % 7, i % 256, next);
  }
  return text;
}

void parse_and_check(benchmark::State& state) {
  const std::string text = text_of_modules(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    Diagnostics diagnostics;
    const auto checked = check(parse(text, diagnostics), {}, diagnostics);
    if (!checked) state.SkipWithError(render(diagnostics, "bench", text).c_str());
    benchmark::DoNotOptimize(checked);
  }
  state.counters["lines"] = static_cast<double>(std::count(text.begin(), text.end(), '\n'));
}
BENCHMARK(parse_and_check)->Arg(23)->Arg(230)->Unit(benchmark::kMillisecond);

void text_to_graph(benchmark::State& state) {
  const std::string text = text_of_modules(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const CompileResult result = compile_grammar({"bench", text});
    CHECK(result.graph);
    benchmark::DoNotOptimize(result.graph);
  }
  state.counters["lines"] = static_cast<double>(std::count(text.begin(), text.end(), '\n'));
}
BENCHMARK(text_to_graph)->Arg(23)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace espalier
