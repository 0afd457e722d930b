#pragma once
// Free growth: a model of a grammar without any target, as searches begin.

#include <cstdint>

#include "derivation/derivation.h"
#include "run/scene.h"

namespace espalier::studio {

/// Number `index` of those of a seed. Scenes for the guided engine: as many steps of growth as it takes; others: grown by
/// moves to the length of the first individuals. At most as many genes as the scene allows. Throws Error.
Derivation grow_freely(const GeneratorGraph& graph, const Scene& scene, std::uint32_t index);

}  // namespace espalier::studio
