#pragma once
// Expected directions: where what grows from a rule may be expected to go (Guiding curves 2018, section 3.4,
// equation 9).

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "grammar/graph.h"

namespace espalier {

struct ExpectationSettings {
  std::uint32_t samples = 40;  // of each rule, 1..100000
  std::uint32_t steps = 10;    // of growth in each, 1..1000
};

/// Per rule the mean of tip - base, m, of the bones of a model that grows from it at the origin: over the bones of each
/// sample, then over the samples. A sample has the arguments and size with which the rule was met in models that grew
/// from the start. Zero where a rule was never met, or makes no bones. A function of graph and seed.
std::vector<Vec3> expected_directions(const GeneratorGraph& graph, std::uint64_t seed,
                                      const ExpectationSettings& settings = {});

}  // namespace espalier
