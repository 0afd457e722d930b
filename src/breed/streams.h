#pragma once
// The random streams of breeding: which stream is for what.

#include <cstdint>

#include "base/check.h"
#include "base/random.h"
#include "breed/breed_problem.h"

namespace espalier {

enum class BreedStream : std::uint32_t { first = 1, select, child, newcomer, sibling, taste };

/// The stream of candidate number `candidate` of a generation.
inline RandomStream stream_of(const BreedProblem& problem, BreedStream what, std::uint32_t generation,
                              std::uint32_t candidate) {
  CHECK(problem.draw < 1u << 16);
  // Lanes of searches are islands, few; these lie far above.
  const std::uint32_t lane = 1u << 23 | static_cast<std::uint32_t>(what) << 16 | problem.draw;
  return RandomStream({problem.seed, Purpose::vary, lane, candidate, generation});
}

}  // namespace espalier
