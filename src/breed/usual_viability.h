#pragma once
// What is usual for a grammar: not every grammar stands on the ground (spaceships), and in some the parts lie inside
// each other by intent.

#include "breed/viability.h"
#include "grammar/graph.h"

namespace espalier {

/// The settings' own bounds, but a rule that more than half of kUsualDraws models drawn from the grammar break is no
/// rule for it: its bound is 1. The same on any machine; a second at most.
ViabilitySettings usual_viability(const GeneratorGraph& graph, const MeshTable& meshes);

inline constexpr std::uint32_t kUsualDraws = 24;

}  // namespace espalier
