#pragma once
// Taking a derivation back to what must stay, so that something else can grow from it.

#include "derivation/derivation.h"
#include "derivation/locks.h"

namespace espalier {

/// Without all that stands in optional slots, but for what locks hold. What required slots hold stays.
Derivation stripped(const GeneratorGraph& graph, const Derivation& derivation, const Locks& locks);

/// Empty slots become open, to be decided once more; those whose state a lock holds stay.
void reopen(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks);

}  // namespace espalier
