#pragma once
// GeneLimits: how many genes an individual may have.

#include <cstdint>

namespace espalier {

/// Hard limits on the size of an individual, both ends allowed.
struct GeneLimits {
  std::uint32_t min = 4;    // ShapeGenetics 2017, experiments
  std::uint32_t max = 100;  // spaceship scene; others allow more

  bool operator==(const GeneLimits&) const = default;
};

}  // namespace espalier
