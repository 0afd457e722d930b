#pragma once
// The first individuals of a search: grown at random to random lengths (ShapeGenetics 2017, Algorithm 1: "repeatedly
// calling the grow mutation"), scored, and redrawn until they are acceptable.

#include <cstdint>
#include <span>
#include <vector>

#include "search/engine.h"
#include "search/gene_limits.h"

namespace espalier {

struct StartSettings {
  std::uint32_t population = 1;
  std::uint32_t length_min = 50, length_max = 50;  // genes, drawn uniformly; required slots may overshoot
  GeneLimits genes;
};

struct StartResult {
  std::vector<Individual> individuals;  // in order of birth, all scored and acceptable
  std::uint64_t evaluations = 0;
  std::uint64_t short_starts = 0;     // could not grow to their length
  std::uint64_t rejected_starts = 0;  // scored, found not acceptable and redrawn
  std::uint64_t copied_starts = 0;    // redrawn in vain: a copy of an acceptable one stands in
};

/// How often a population is begun before what is still missing of it is copied from what was acceptable.
inline constexpr std::uint32_t kMostStartRounds = 50;

/// The first places are taken by `founders`, which have scores; the rest is grown from one gene, or where the problem
/// has locks from what these hold of its founders. `epoch` tells populations of one search apart. Where nothing that
/// was grown is acceptable, places are copied from `stand_ins`. Throws Error where the graph yields no derivation
/// within the gene limits, or none that is acceptable in kMostStartRounds * population tries.
StartResult make_initial_population(const SearchProblem& problem, const StartSettings& settings, std::uint32_t epoch,
                                    std::span<const Individual> founders, std::span<const Individual> stand_ins);

}  // namespace espalier
