#pragma once
// How encoded derivations spell slot states and edges.

#include <string>
#include <string_view>

#include "derivation/derivation.h"

namespace espalier {

/// Indexed by SlotState.
inline constexpr std::string_view kSlotLetters = "OEFA";

/// The name of an edge; of the way in, which may have none, that of the start rule.
inline const std::string& edge_label(const GeneratorGraph& graph, EdgeId edge) {
  return edge == 0 ? graph.rules[graph.start()].name : graph.edges[edge].name;
}

}  // namespace espalier
