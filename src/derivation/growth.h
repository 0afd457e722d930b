#pragma once
// Growth: makes fresh genes and what they require. Used by sampling and by every move that adds genes.

#include <cstdint>
#include <vector>

#include "base/random.h"
#include "derivation/limits.h"
#include "derivation/writer.h"

namespace espalier {

/// Why a gene could not be grown.
enum class GrowthFault : std::uint8_t {
  none,
  limit,       // a rule would have more genes than its limit
  too_big,     // what is required below has no end within the budget
  no_variant,  // every alternative of a choice weighs 0 at this depth
};

/// Appends the states of a fresh gene's slots: `open`, or absent where the guard of the child's rule fails.
void append_open_slots(const GeneratorGraph& graph, const Rule& rule, const Variant& variant, const DepthCounts& below,
                       std::vector<SlotState>& slots);
/// Appends a variant's draws, fresh.
void append_draws(const Variant& variant, RandomStream& random, std::vector<std::uint32_t>& draws);

enum class OptionalSlots : std::uint8_t {
  empty,
  by_prior,  // filled with their probability: the subtree is a draw from the prior
};

class Growth {
 public:
  static constexpr std::uint32_t kMostGenes = 100'000;

  /// Grows a gene in a slot of `edge`, with its descendants, depth-first; `optional` says of which slots. Appends
  /// the subtree to `out` and counts it into `ledger`; both are left half done if there is a fault. The guard of the
  /// gene itself must hold. `above` counts the genes above it.
  GrowthFault append(const GeneratorGraph& graph, EdgeId edge, const DepthCounts& above, RandomStream& random,
                     LimitLedger& ledger, Derivation& out, std::uint32_t most_genes = kMostGenes,
                     OptionalSlots optional = OptionalSlots::empty);

 private:
  struct Frame {
    std::size_t slots;       // where the gene's slots begin in out
    std::size_t slot;        // next one to look at
    const Rule* rule;
    const Variant* variant;
  };

  GrowthFault push(const GeneratorGraph& graph, EdgeId edge, RandomStream& random, LimitLedger& ledger,
                   Derivation& out);
  double fill_probability_at(const Frame& frame, const Edge& edge);

  std::vector<Frame> stack_;
  DepthCounter above_;  // of the next gene to be pushed
  TreeWriter writer_;
};

}  // namespace espalier
