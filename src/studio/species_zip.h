#pragma once
// A species pack as one file: many distinct relatives of an individual, within the limits of its session.

#include <cstdint>
#include <string>
#include <vector>

#include "studio/breeding_bench.h"

namespace espalier::studio {

struct SpeciesZipRequest {
  std::uint32_t count = 20;            // 1..SpeciesSettings::kMostSiblings
  api::RoomSettings settings;          // its limits hold for all
  std::vector<api::DrawPlace> locked;  // what relatives have as the favourite has it
  std::uint64_t seed = 1;
  std::string stem;                    // of the folder within
};

/// A zip of what write_species_files writes. Equal arguments give equal bytes. Throws Error where none was found.
std::string species_zip(BreedingBench& bench, Executor& executor, const Derivation& favourite,
                        const SpeciesZipRequest& request);

}  // namespace espalier::studio
