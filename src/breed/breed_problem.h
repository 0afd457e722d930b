#pragma once
// BreedProblem: what is bred, and what is held while it is. Everything that breeding draws is a function of `seed`,
// `draw` and the number of the generation.

#include <cstdint>
#include <memory>

#include "breed/appraiser.h"
#include "breed/draw_locks.h"

namespace espalier {

struct BreedProblem {
  std::shared_ptr<const GeneratorGraph> graph;
  Held held;
  Appraiser* appraiser = nullptr;  // never null
  std::uint64_t seed = 0;
  std::uint32_t draw = 0;  // another one draws other children of the same parents ("again"); below 2^16
};

}  // namespace espalier
