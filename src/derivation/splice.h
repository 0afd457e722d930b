#pragma once
// Splicing: putting one subtree in the place of another. Block moves; only the counts of the genes above change.

#include <span>

#include "derivation/position.h"

namespace espalier {

/// child = `host` with its subtree `removed` replaced by the subtree `inserted` of `donor`; either may have length 0.
/// `above` is the way to the place in the host. The states of slots are the caller's business. `child` is neither host
/// nor donor; its storage is reused.
void splice(const Derivation& host, const SubtreeSlice& removed, const Derivation& donor, const SubtreeSlice& inserted,
            std::span<const PathStep> above, Derivation& child);

/// The same in place; `donor` is another derivation than `host`.
void splice_in_place(Derivation& host, const SubtreeSlice& removed, const Derivation& donor,
                     const SubtreeSlice& inserted, std::span<const PathStep> above);

/// All of a derivation that holds just one subtree, its top gene first.
SubtreeSlice whole(const Derivation& derivation);

}  // namespace espalier
