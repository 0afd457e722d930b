// Feeds any bytes through everything from text to model: what compiles is sampled, moved, crossed over, expanded in all
// phases, encoded and read back. Budgets hold, derivations stay valid, and a second run makes the same model.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "base/check.h"
#include "base/error.h"
#include "derivation/crossover.h"
#include "derivation/encode.h"
#include "derivation/moves.h"
#include "derivation/nudge.h"
#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "model/expand.h"

namespace espalier {
namespace {

constexpr std::uint32_t kMostGenes = 60;
constexpr ExpandLimits kLimits{.most_parts = 500, .most_turns = 2000, .most_copies = 20'000};

void expand_all(const GeneratorGraph& graph, const Derivation& derivation) {
  Expander expander(graph, kLimits), other(graph, kLimits);
  Model model, again;
  for (const ExpandTo phase : {ExpandTo::bones, ExpandTo::parts, ExpandTo::full}) {
    expander.expand(derivation, phase, model);
    CHECK(model.instances.size() <= kLimits.most_parts);
    CHECK(phase != ExpandTo::bones || model.instances.empty());
    for (const Instance& i : model.instances) {
      CHECK(i.mesh < graph.meshes.size());
      CHECK(i.gene < derivation.size());
    }
    for (const Bone& bone : model.bones) CHECK(bone.gene < derivation.size());
  }
  other.expand(derivation, ExpandTo::full, again);
  CHECK(again.instances.size() == model.instances.size());
  for (std::size_t i = 0; i < model.instances.size(); ++i)
    CHECK(std::memcmp(&model.instances[i].model_from_mesh, &again.instances[i].model_from_mesh, sizeof(Frame)) == 0);
}

void exercise(const GeneratorGraph& graph, std::uint64_t seed) {
  RandomStream random({seed, Purpose::test});
  Derivation one = sample(graph, random, kMostGenes).derivation;
  CHECK(find_fault(graph, one).empty());
  expand_all(graph, one);
  Derivation two = seedling(graph, random);
  if (!close_open_slots(graph, two, random) || !close_open_slots(graph, one, random)) return;
  if (one.size() > 2000 || two.size() > 2000) return;
  for (int step = 0; step < 4; ++step) {
    grow(graph, one, {}, random);
    alter(graph, two, {}, random);
    cut(graph, one, {}, random);
    CHECK(find_fault(graph, one).empty());
    CHECK(find_fault(graph, two).empty());
    Derivation a, b;
    if (crossover(graph, one, two, {}, {}, {}, random, a, b).crossed) one = a, two = b;
  }
  CHECK(decode(graph, encode(graph, one)) == one);
  expand_all(graph, two);
}

}  // namespace
}  // namespace espalier

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  const CompileResult result = compile_grammar({"fuzz.esp", std::string(reinterpret_cast<const char*>(data), size)});
  CHECK(static_cast<bool>(result.graph) == !result.diagnostics.has_errors());
  if (!result.graph) return 0;
  try {
    exercise(*result.graph, size);
  } catch (const Error&) {
    // Limits that sampling cannot keep, weights that are all 0: told, not crashed.
  }
  return 0;
}
