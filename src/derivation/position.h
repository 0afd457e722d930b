#pragma once
// Where genes stand. Records hold only counts relative to their slices, so a place is found by walking down from the
// start gene: in time proportional to the siblings passed on the way, not to the size of the derivation.

#include <cstdint>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

/// Counts the genes above while something walks down or through a derivation (language.md 6).
class DepthCounter {
 public:
  /// At the start gene: nothing is above.
  void reset(const GeneratorGraph& graph) {
    depth_ = 0;
    of_rule_.assign(graph.counted_rules.size(), 0);
  }
  void reset(const DepthCounts& counts) {
    depth_ = counts.depth;
    of_rule_.assign(counts.of_rule.begin(), counts.of_rule.end());
  }
  /// From a gene of `rule` to its children, and back.
  void enter(const Rule& rule) {
    ++depth_;
    if (rule.counted) ++of_rule_[*rule.counted];
  }
  void leave(const Rule& rule) {
    --depth_;
    if (rule.counted) --of_rule_[*rule.counted];
  }
  /// Valid until the counter changes.
  DepthCounts counts() const { return {depth_, of_rule_}; }

 private:
  std::uint32_t depth_ = 0;
  std::vector<std::uint32_t> of_rule_;
};

bool operator==(const DepthCounts& a, const DepthCounts& b);

/// A subtree: where its slices start and how long they are, its top gene included. Length 0: a place between genes.
struct SubtreeSlice {
  GenePosition begin;
  std::uint32_t genes = 0;
  std::uint32_t slots = 0;
  std::uint32_t draws = 0;
};

inline SubtreeSlice subtree_at(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& gene) {
  const GeneRecord& record = derivation.genes[gene.gene];
  const Variant& variant = variant_of(graph, record);
  return {gene, 1 + record.genes_below, static_cast<std::uint32_t>(variant.slots.size()) + record.slots_below,
          static_cast<std::uint32_t>(variant.draws.size()) + record.draws_below};
}

/// The place just behind a subtree: its next sibling's, if it has one.
inline GenePosition end_of(const SubtreeSlice& slice) {
  return {slice.begin.gene + slice.genes, slice.begin.slot + slice.slots, slice.begin.draw + slice.draws};
}

/// Where the first child of a gene stands, or would stand.
inline GenePosition first_child(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& gene) {
  const Variant& variant = variant_of(graph, derivation.genes[gene.gene]);
  return {gene.gene + 1, gene.slot + static_cast<std::uint32_t>(variant.slots.size()),
          gene.draw + static_cast<std::uint32_t>(variant.draws.size())};
}

/// Where the child in slot `slot` (index into the variant's slots) of `gene` stands, or would stand if it were filled.
GenePosition child_in_slot(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& gene,
                           std::uint32_t slot);

/// Calls visit(slot, position) for every child of a gene, in order; `slot` indexes the variant's slots.
template <class Visit>
void for_each_child(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& gene, Visit visit) {
  const std::size_t slots = variant_of(graph, derivation.genes[gene.gene]).slots.size();
  GenePosition child = first_child(graph, derivation, gene);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    if (derivation.slots[gene.slot + slot] != SlotState::filled) continue;
    const GenePosition next = end_of(subtree_at(graph, derivation, child));
    visit(slot, child);
    child = next;
  }
}

/// One step of the way down: a gene, and which of its variant's slots leads on.
struct PathStep {
  GenePosition gene;
  std::uint32_t slot = 0;
};

/// The way from the start gene to a gene. Keep one and reuse it: its storage stays.
struct GenePath {
  std::vector<PathStep> steps;  // the genes above, the start gene first, the parent last
  GenePosition gene;
  DepthCounter above;  // what the gene's guard, weights and probabilities are evaluated with
};

/// Finds the way to gene number `gene` < derivation.size().
void locate(const GeneratorGraph& graph, const Derivation& derivation, std::uint32_t gene, GenePath& path);

}  // namespace espalier
