#include "score/measure.h"

namespace espalier {

const MeasureFacts& facts_of(Measure measure) {
  static constexpr std::array<MeasureFacts, kMeasures> kFacts = {{
      {"genes", "genes", 1, 1e6, true, true},
      {"depth", "levels", 0, 1e6, true, true},
      {"parts", "parts", 0, 1e9, true, false},
      {"triangles", "triangles", 0, 1e12, true, false},
      {"height", "m", 0, 1e9, false, false},
      {"spread", "m", 0, 1e9, false, false},
      {"volume", "m3", 0, 1e18, false, false},
      {"balance", "", 0, 1, false, true},
  }};
  return kFacts[static_cast<std::size_t>(measure)];
}

}  // namespace espalier
