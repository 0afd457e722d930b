#pragma once
// A species pack as one file: many distinct relatives of an individual, each within a limit of triangles.

#include <cstdint>
#include <string>

#include "studio/breeding_bench.h"

namespace espalier::studio {

/// A zip of STEM/001.glb, ... and STEM/species.json, which says of each its triangles, height and spread, and how many
/// were refused and why. `most_triangles` 0: without limit. Equal arguments give equal bytes. Throws Error where none
/// was found.
std::string species_zip(BreedingBench& bench, Executor& executor, const Derivation& favourite, std::uint32_t count,
                        std::int64_t most_triangles, std::uint64_t seed, const std::string& stem);

}  // namespace espalier::studio
