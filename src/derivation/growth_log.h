#pragma once
// GrowthLog: one derivation of a pool by itself, in its order of growth, so that it can be saved and go on as before.

#include <cstdint>
#include <vector>

#include "derivation/growth_pool.h"

namespace espalier {

struct GrowthLog {
  struct Entry {
    std::uint32_t above = 0;  // index of the gene's entry that has the slot; of the first entry without meaning
    std::uint16_t slot = 0;   // index into that gene's variant's slots
    bool filled = true;
    EdgeId edge = 0;          // of the filled
    std::uint16_t variant = 0;
  };
  struct Place {
    std::uint32_t entry = 0;
    std::uint16_t slot = 0;
  };

  std::uint64_t detail_seed = 0;
  std::vector<Entry> entries;
  std::vector<std::uint32_t> draws;  // of the filled, one after the other
  std::vector<Place> open;           // in the order of GrowingDerivation::open
};

GrowthLog log_of(const GrowthPool& pool, const GrowingDerivation& growing);

/// Throws Error for what no growth can have made: another edge than the slot's, a slot that is absent or decided twice,
/// too few draws, ...
GrowingDerivation restore(const GeneratorGraph& graph, const GrowthLog& log, GrowthPool& pool);

}  // namespace espalier
