#pragma once
// The prior over derivations, and sampling from exactly that.

#include "base/random.h"
#include "derivation/derivation.h"

namespace espalier {

/// log prior: log(weight / total) per choice, log p per filled and log(1 - p) per empty optional slot; draws, required,
/// absent and open slots add 0. Limits only reject, they never renormalise (language.md 8). -infinity for what sampling
/// never makes. The same bits on every CPU. Linear time.
double log_prior(const GeneratorGraph& graph, const Derivation& derivation);

/// One gene of the start rule: detail seed, variant and draws from the prior, every slot open (or absent).
Derivation seedling(const GeneratorGraph& graph, RandomStream& random);

struct SampleResult {
  Derivation derivation;
  bool truncated = false;  // the budget ran out: some slots are still open
};

/// Draws from the prior, deciding slots breadth-first until there are `most_genes` >= 1; the rest stays open
/// (language.md 10). The detail seed comes first from the stream. A draw that breaks a `limit` is thrown away and drawn
/// again, at most 1000 times, then Error naming the rule; Error too where all weights of a choice are 0.
SampleResult sample(const GeneratorGraph& graph, RandomStream& random, std::uint32_t most_genes = 10'000);

/// One step of growth in random order: decides open slots, picked uniformly, by the prior until a gene has been made
/// that emits or has a bone, or none is open, or 1000 genes were made (SOSMC's order; language.md 13). New genes have
/// open slots. A slot whose rule has reached its limit is decided empty if optional, and left open if required. False
/// if nothing could be decided.
bool grow_open_slot(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random);

/// Closes every open slot: optional ones become empty, required ones are grown (their optional slots empty). False, and
/// the derivation untouched, if limits or endless required growth left no way in 100 tries.
bool close_open_slots(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random);

/// The gene's program emits or makes a bone: what ends a step of growth.
bool makes_something(const Variant& variant);

}  // namespace espalier
