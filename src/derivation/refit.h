#pragma once
// Refit: what a subtree must change when other genes come to stand above it, since guards are tested with their number.

#include <vector>

#include "derivation/sweep.h"

namespace espalier {

/// A slot that takes another state; `slot` counts from the first slot of the subtree.
struct SlotPatch {
  std::uint32_t slot = 0;
  SlotState state = SlotState::empty;
};

/// Replaces `patches` by what must change in the subtree at `top` to stand below `above`. Empty and open slots whose
/// guard fails there become absent, absent ones whose guard holds become empty. False if that is not enough: a gene's
/// guard fails, a required slot would be empty, or a variant or a filled slot has probability 0 there. The guard of the
/// top gene itself is not tested. `sweep` is scratch.
bool refit(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& top, const DepthCounts& above,
           GeneSweep& sweep, std::vector<SlotPatch>& patches);

}  // namespace espalier
