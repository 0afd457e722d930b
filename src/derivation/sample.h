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

enum class SlotOrder : std::uint8_t {
  random,       // any open slot, uniformly: SOSMC (Ritchie et al. 2015)
  depth_first,  // in the order of the text, what stands in a slot before the next slot: SMC
};

enum class GrowthStep : std::uint8_t {
  finished,  // there was nothing to decide: the derivation is as before
  grown,
  stuck,     // strict growth only: the prior would throw this derivation away
};

/// One step of growth: decides open slots by the prior, in the given order and each once, until a gene has been made
/// that emits or has a bone, or none is open, or 1000 genes were made (language.md 13). New genes have open slots.
/// Where a slot's rule has reached its limit, or all weights of its alternatives are 0, lenient growth decides
/// optional slots empty and leaves required ones open. Strict growth ends `stuck`: then what is not stuck is
/// distributed as the prior, in whichever order it grew (limits only reject, language.md 8).
GrowthStep grow_open_slot(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random,
                          SlotOrder order = SlotOrder::random, bool strict = false);

/// No slot is open.
bool is_finished(const Derivation& derivation);

/// Closes every open slot: optional ones become empty, required ones are grown (their optional slots empty). False, and
/// the derivation untouched, if limits or endless required growth left no way to at most `most_genes` genes in 100 tries.
bool close_open_slots(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random,
                      std::uint32_t most_genes = 100'000);

/// The gene's program emits or makes a bone: what ends a step of growth.
bool makes_something(const Variant& variant);

}  // namespace espalier
