#pragma once
// The prior over derivations, and sampling from exactly that.

#include "base/random.h"
#include "derivation/derivation.h"

namespace espalier {

/// log prior: log(weight / total) per choice, log p per filled and log(1 - p) per empty optional slot; draws, required,
/// absent and open slots add 0. Limits only reject, they never renormalise. (language.md 8)
double log_prior(const GeneratorGraph& graph, const Derivation& derivation);

/// One gene of the start rule: variant and draws from the prior, every slot open (or absent).
Derivation seedling(const GeneratorGraph& graph, RandomStream& random);

struct SampleResult {
  Derivation derivation;
  bool truncated = false;  // the budget ran out: some slots are still open
};

/// Draws from the prior, deciding slots breadth-first until `most_genes`; the rest stays open. A draw that breaks a
/// `limit` is thrown away and drawn again (at most 1000 times, then Error).
SampleResult sample(const GeneratorGraph& graph, RandomStream& random, std::uint32_t most_genes = 10'000);

/// One step of growth in random order: decides random open slots by the prior until a gene has been made that emits or
/// has a bone, or none is open. False if nothing was open. (SOSMC's order; language.md 13)
bool grow_open_slot(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random);

/// Closes every open slot: optional ones become empty, required ones are grown (their optional slots empty).
void close_open_slots(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random);

}  // namespace espalier
