#pragma once
// VariationKind: how the genetic algorithm makes a child from its parent.

#include <cstddef>
#include <cstdint>

namespace espalier {

enum class VariationKind : std::uint8_t { grow, cut, alter, nudge, crossover };
inline constexpr std::size_t kVariationKinds = 5;
inline constexpr const char* kVariationNames[kVariationKinds] = {"grow", "cut", "alter", "nudge", "crossover"};

}  // namespace espalier
